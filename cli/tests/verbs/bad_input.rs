//! This file holds what a person may hand to the program by mistake: each ends in one line, exit code 3, and nothing
//! half-written.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

fn rigproof(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rigproof"));
    command.args(arguments).output().unwrap()
}

fn good_recording() -> String {
    let rows: String = (0..20)
        .map(|i| format!("{i}.25,{}e-1,1.5\n", 2 * i + 1))
        .collect();
    format!("t_s,x_mm,force (N)\n{rows}")
}

/// A folder with one input, and the place of an output that must not appear.
struct Desk {
    folder: TempDir,
}

impl Desk {
    fn new() -> Desk {
        Desk {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn put(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, text).unwrap();
        path
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// Converts the input and checks that it is refused in one line that says `expected`.
    fn refused(&self, input: &Path, output: &Path, more: &[&str], expected: &str) {
        let before = self.names();
        let mut arguments = vec!["convert", input.to_str().unwrap(), output.to_str().unwrap()];
        arguments.extend(more);
        let answer = rigproof(&arguments);
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{message}");
        assert!(
            message.starts_with("error: ") && message.lines().count() == 1,
            "{message}"
        );
        assert!(message.contains(expected), "{message} lacks {expected}");
        assert!(answer.stdout.is_empty());
        assert_eq!(self.names(), before);
    }
}

#[test]
fn a_recording_with_a_fault_is_refused_at_its_place() {
    let good = good_recording();
    let last = "19.25,39e-1,1.5\n";
    for (text, expected) in [
        (
            good.replace("t_s", "stamp"),
            "line 1: there is no time column",
        ),
        (
            good.replace(last, "19.25,inf,1.5\n"),
            "line 21, column 2 `x_mm`: `inf` is no finite number",
        ),
        (
            good.replace(last, "19.25,far,1.5\n"),
            "`far` is no finite number",
        ),
        (
            good.replace(last, "18.25,39e-1,1.5\n"),
            "line 21, column 1 `t_s`: the time stamp is repeated",
        ),
        (
            good.replace(last, "3.5,39e-1,1.5\n"),
            "the time stamp 3.5 s goes backward after 18.25 s",
        ),
        (
            good.replace(last, "19.25,39\n"),
            "line 21: the line has 2 cells, the header has 3",
        ),
        (
            good.replace("t_s", "time (furlong)"),
            "`furlong` is no unit of time",
        ),
        (
            good.replace("x_mm", "force (N)"),
            "column 3 `force`: the name stands over column 2 already",
        ),
        (
            good.lines()
                .take(3)
                .map(|line| format!("{line}\n"))
                .collect(),
            "has 2 samples, at least 16",
        ),
        (good.lines().take(1).collect(), "has 0 samples"),
        (String::new(), "the file is empty"),
        ("\u{1}\0\u{2}\n".into(), "the file holds NUL bytes"),
    ] {
        let desk = Desk::new();
        let input = desk.put("run.csv", text);
        desk.refused(&input, &desk.path("out.csv"), &[], expected);
    }
}

#[test]
fn a_variable_that_is_not_there_is_named_with_those_that_are() {
    let desk = Desk::new();
    let input = desk.put("run.csv", good_recording());
    let output = desk.path("out.csv");
    desk.refused(
        &input,
        &output,
        &["--variables", "torque"],
        "the columns are `x_mm`, `force`",
    );
    desk.refused(
        &input,
        &output,
        &["--time-from", "stamp"],
        "there is no time column `stamp`",
    );
}

#[test]
fn a_huge_file_without_text_is_refused_at_once_in_little_memory() {
    let desk = Desk::new();
    let input = desk.path("run.csv");
    fs::File::create(&input).unwrap().set_len(10 << 30).unwrap();
    let started = std::time::Instant::now();
    desk.refused(
        &input,
        &desk.path("out.csv"),
        &[],
        "line 1: the file holds NUL bytes",
    );
    assert!(started.elapsed().as_secs() < 10);
}

#[test]
fn places_that_hold_no_file_or_take_none_are_refused() {
    let desk = Desk::new();
    let input = desk.put("run.csv", good_recording());
    let folder = desk.path("folder");
    fs::create_dir(&folder).unwrap();
    let output = desk.path("out.csv");
    desk.refused(&folder, &output, &[], "it is a folder; name a file");
    desk.refused(
        &desk.path("none.csv"),
        &output,
        &[],
        "there is no such file or folder",
    );
    let taken = desk.path("taken.csv");
    fs::create_dir(&taken).unwrap();
    desk.refused(&input, &taken, &[], "cannot write");
    desk.refused(
        &input,
        &desk.path("none").join("out.csv"),
        &[],
        "there is no such file or folder",
    );
    desk.refused(
        &input,
        &input.join("out.csv"),
        &[],
        "is a file, not a folder",
    );
}

#[test]
fn a_file_that_is_not_what_its_name_says_is_refused() {
    let desk = Desk::new();
    let input = desk.put("run.h5", good_recording());
    desk.refused(
        &input,
        &desk.path("out.csv"),
        &["--rate-hz", "90"],
        "neither HDF5 nor MATLAB",
    );
    let input = desk.put("run.mat", "MATLAB 5.0 MAT-file");
    desk.refused(
        &input,
        &desk.path("out.csv"),
        &["--rate-hz", "90"],
        "the MATLAB file cannot be read",
    );
}

#[cfg(unix)]
#[test]
fn a_file_without_permission_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    let input = desk.put("run.csv", good_recording());
    let mode =
        |path: &Path, mode| fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    mode(&input, 0o000);
    if fs::File::open(&input).is_ok() {
        println!("passed over: whoever runs this test may read everything");
        return;
    }
    desk.refused(&input, &desk.path("out.csv"), &[], "permission is denied");
    mode(&input, 0o600);
    let folder = desk.path("folder");
    fs::create_dir(&folder).unwrap();
    mode(&folder, 0o500);
    desk.refused(&input, &folder.join("out.csv"), &[], "permission is denied");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

#[test]
fn an_earlier_output_survives_a_refusal() {
    let desk = Desk::new();
    let input = desk.put("run.csv", "t,x\n");
    let output = desk.put("out.csv", "earlier");
    desk.refused(&input, &output, &[], "has 0 samples");
    assert_eq!(fs::read_to_string(output).unwrap(), "earlier");
}

#[test]
fn a_wrong_command_line_has_an_exit_code_of_its_own() {
    let desk = Desk::new();
    let input = desk.put("run.csv", good_recording());
    let input = input.to_str().unwrap();
    let output = desk.path("out.csv");
    let output = output.to_str().unwrap();
    for arguments in [
        vec!["convert", input],
        vec!["convert", input, output, "--unit", "force=furlong"],
        vec!["convert", input, output, "--rate-hz", "90"],
        vec![
            "convert",
            input,
            output,
            "--rate-hz",
            "90",
            "--time-from",
            "t_s",
        ],
        vec!["invert"],
    ] {
        let answer = rigproof(&arguments);
        assert_eq!(answer.status.code(), Some(2), "{arguments:?}");
        assert!(!Path::new(output).exists());
    }
}
