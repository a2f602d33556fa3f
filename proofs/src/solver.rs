//! This file asks the solver: one question, one child process, a bound on its time.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::script::Script;
use crate::width::Width;

/// Which solver: installed with `pip install bitwuzla==0.9.1`.
pub const VERSION: &str = "0.9.1";
/// Longest time for one question.
const LONGEST: Duration = Duration::from_secs(60);
const DRIVER: &str = include_str!("solver.py");

/// A Python that has bitwuzla.
#[derive(Clone, Debug)]
pub struct Solver {
    python: PathBuf,
}

/// What the solver says.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// No numbers are so.
    Unsatisfiable,
    /// These are, by the number of the unknown; unknowns that do not matter are zero.
    Satisfiable(Vec<f64>),
    /// Neither was shown; why.
    Unknown(String),
}

impl Solver {
    /// The solver of a Python.
    ///
    /// # Errors
    /// Why it cannot be used: no such Python, no bitwuzla in it, or another version.
    pub fn find(python: &Path) -> Result<Solver, String> {
        let version = Command::new(python)
            .args([
                "-c",
                "import importlib.metadata as m; print(m.version('bitwuzla'))",
            ])
            .output()
            .map_err(|error| format!("{}: {error}", python.display()))?;
        let found = String::from_utf8_lossy(&version.stdout).trim().to_owned();
        if found != VERSION {
            return Err(format!(
                "{}: bitwuzla {VERSION} is not there",
                python.display()
            ));
        }
        Ok(Solver {
            python: python.to_owned(),
        })
    }

    /// Asks.
    pub fn ask(&self, script: &Script) -> Answer {
        let Script {
            text,
            inputs,
            width,
        } = script;
        match self.run(text, inputs) {
            Ok(answer) => read_answer(&answer, inputs, *width),
            Err(why) => Answer::Unknown(why),
        }
    }

    fn run(&self, question: &str, inputs: &[u32]) -> Result<String, String> {
        let mut child = Command::new(&self.python)
            .args(["-c", DRIVER])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| format!("the solver did not start: {error}"))?;
        if let Some(mut pipe) = child.stdin.take() {
            let names: Vec<String> = inputs.iter().map(|input| format!("i{input}")).collect();
            let text = format!("{question}{}\n", names.join(" "));
            // A solver that died says so below.
            let _ = pipe.write_all(text.as_bytes());
        }
        wait(&mut child)?;
        let mut answer = String::new();
        if let Some(mut pipe) = child.stdout.take() {
            let read = pipe.read_to_string(&mut answer);
            read.map_err(|error| format!("the solver's answer is unreadable: {error}"))?;
        }
        Ok(answer)
    }
}

fn wait(child: &mut Child) -> Result<(), String> {
    let start = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) if status.success() => return Ok(()),
            Ok(Some(status)) => return Err(format!("the solver died: {status}")),
            Ok(None) if start.elapsed() < LONGEST => std::thread::sleep(Duration::from_millis(2)),
            Ok(None) => {
                let _ = child.kill();
                let _ = child.wait();
                return Err(format!("the solver took more than {} s", LONGEST.as_secs()));
            }
            Err(error) => return Err(format!("the solver is lost: {error}")),
        }
    }
}

/// Only the word UNSAT proves.
fn read_answer(answer: &str, inputs: &[u32], width: Width) -> Answer {
    let mut lines = answer.lines();
    match lines.next() {
        Some("UNSAT") => Answer::Unsatisfiable,
        Some("SAT") => {
            let count = inputs.last().map_or(0, |last| *last as usize + 1);
            let mut numbers = vec![0.0; count];
            for (input, bits) in inputs.iter().zip(lines) {
                let number = u64::from_str_radix(bits.trim(), 2).ok();
                match number.and_then(|bits| width.of_bits(bits)) {
                    Some(number) => numbers[*input as usize] = number,
                    None => return Answer::Unknown(format!("the solver gave the bits `{bits}`")),
                }
            }
            Answer::Satisfiable(numbers)
        }
        _ => Answer::Unknown(format!("the solver said `{}`", answer.trim())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_word_unsat_proves() {
        assert_eq!(
            read_answer("UNSAT\n", &[0], Width::Double),
            Answer::Unsatisfiable
        );
        for answer in ["", "UNKNOWN\n", "unsat", "SAT\nx\n", "Traceback"] {
            assert!(
                matches!(read_answer(answer, &[0], Width::Double), Answer::Unknown(_)),
                "{answer}"
            );
        }
        let three = format!("SAT\n{:b}\n", 3.25_f64.to_bits());
        assert_eq!(
            read_answer(&three, &[1], Width::Double),
            Answer::Satisfiable(vec![0.0, 3.25])
        );
        assert!(matches!(
            read_answer(&three, &[1], Width::Single),
            Answer::Unknown(_)
        ));
    }

    #[test]
    fn a_solver_that_dies_proves_nothing() {
        for python in ["false", "no-such-program"] {
            let solver = Solver {
                python: PathBuf::from(python),
            };
            let script = Script {
                text: "(check-sat)\n".to_owned(),
                inputs: Vec::new(),
                width: Width::Double,
            };
            assert!(matches!(solver.ask(&script), Answer::Unknown(_)));
            assert!(Solver::find(Path::new(python)).is_err());
        }
    }
}
