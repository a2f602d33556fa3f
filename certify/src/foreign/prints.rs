//! This file keeps the last of what a controller prints, however much that is.

use std::collections::VecDeque;
use std::io::Read;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use super::held;

/// What the host prints between one trial and the next, so that a finding shows nothing of an earlier trial.
pub const MARK: &[u8] = b"\0rigproof: a trial begins\0\n";

/// Most bytes that are kept.
const KEPT: usize = 8192;
/// Most lines that are shown, and most characters of each.
const LINES: usize = 5;
const CHARACTERS: usize = 160;
/// Time for the last prints of a process that has ended.
const LAST_MS: u64 = 1000;

/// The prints of one process.
#[derive(Debug)]
pub struct Prints {
    kept: Arc<Mutex<VecDeque<u8>>>,
    /// Hears of the end when the other half goes.
    over: Receiver<()>,
}

impl Prints {
    /// Reads to the end, on a thread of its own.
    pub fn of(source: impl Read + Send + 'static) -> Prints {
        let kept = Arc::new(Mutex::new(VecDeque::new()));
        let (going, over) = channel();
        let keeper = Arc::clone(&kept);
        std::thread::spawn(move || keep(source, &keeper, going));
        Prints { kept, over }
    }

    /// The last lines of this trial, of a process that has ended: nothing, or words to end a message with.
    pub fn last(&self) -> String {
        // Either way what is there is shown.
        let _ = self.over.recv_timeout(Duration::from_millis(LAST_MS));
        let kept = held(&self.kept);
        let bytes: Vec<u8> = kept.iter().copied().collect();
        drop(kept);
        let lines = last_lines(&bytes);
        match lines.is_empty() {
            true => String::new(),
            false => format!("; it last printed: {}", lines.join(" | ")),
        }
    }
}

fn keep(mut source: impl Read, kept: &Mutex<VecDeque<u8>>, _going: Sender<()>) {
    let mut piece = [0; KEPT];
    loop {
        match source.read(&mut piece) {
            Ok(0) => return,
            Ok(bytes) => {
                let mut kept = held(kept);
                kept.extend(piece.iter().take(bytes));
                let beyond = kept.len().saturating_sub(KEPT);
                kept.drain(..beyond);
            }
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(_) => return,
        }
    }
}

/// The last lines after the last mark, without what steers a terminal.
fn last_lines(bytes: &[u8]) -> Vec<String> {
    let marks = bytes
        .windows(MARK.len())
        .rposition(|window| window == MARK)
        .map(|start| start + MARK.len());
    let of_this_trial = bytes.get(marks.unwrap_or(0)..).unwrap_or_default();
    let text = String::from_utf8_lossy(of_this_trial);
    let lines = text.lines().map(|line| {
        let shown = line.chars().filter(|character| !character.is_control());
        shown.take(CHARACTERS).collect::<String>()
    });
    let mut lines: Vec<String> = lines.filter(|line| !line.trim().is_empty()).collect();
    lines.drain(..lines.len().saturating_sub(LINES));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_lines_of_this_trial_are_kept() {
        let mut printed = b"of an earlier trial\n".to_vec();
        printed.extend_from_slice(MARK);
        assert_eq!(Prints::of(std::io::Cursor::new(printed.clone())).last(), "");
        for line in 0..7 {
            printed.extend_from_slice(format!("line {line}\x1b[2J\n\n").as_bytes());
        }
        let last = Prints::of(std::io::Cursor::new(printed)).last();
        assert_eq!(
            last,
            "; it last printed: line 2[2J | line 3[2J | line 4[2J | line 5[2J | line 6[2J"
        );
    }

    #[test]
    fn megabytes_are_read_and_little_is_kept() {
        let much = std::io::repeat(b'x').take(20 << 20);
        let prints = Prints::of(much.chain(std::io::Cursor::new(b"\nthe end\n".to_vec())));
        assert!(prints.last().ends_with("x | the end"));
        assert!(held(&prints.kept).len() <= KEPT);
    }
}
