//! This file names what is not finished yet, and takes away what a process left that was killed: it knows by a lock and by the process's number whether one is alive.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What such a name begins and ends with; the number of the process stands between.
const BEGIN: &str = ".rigproof-";
const END: &str = ".part";
/// In a part: the folder that stood at the place before, and the name of that place, for a system that cannot exchange two folders in one step.
pub const EARLIER: &str = "earlier";
pub const PLACE: &str = "place";

/// The folders that this process has looked through.
static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Names for what is not finished yet.
pub fn builder() -> tempfile::Builder<'static, 'static> {
    static NAME: std::sync::LazyLock<String> =
        std::sync::LazyLock::new(|| format!("{BEGIN}{}-", std::process::id()));
    let mut builder = tempfile::Builder::new();
    builder.prefix(NAME.as_str()).suffix(END);
    builder
}

/// Whether a name is one of something that is not finished, or was left.
pub fn is_part(name: &str) -> bool {
    name.starts_with(BEGIN) && name.ends_with(END)
}

/// Shows others, as long as this is open, that what it is has an owner.
pub fn hold(part: &File) {
    // On a system without locks the process's number has to do.
    let _ = part.try_lock();
}

/// Takes away what dead processes left in a folder, once in the life of this one, and puts back what they had taken away last.
pub fn sweep(folder: &Path) {
    let Ok(whole) = folder.canonicalize() else {
        return;
    };
    let mut swept = SWEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if swept.insert(whole.clone()) {
        sweep_now(&whole);
    }
}

/// As [`sweep`], however often.
pub fn sweep_now(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let owner = name.to_str().filter(|name| is_part(name)).and_then(owner);
        if owner.is_some_and(|owner| !is_alive(owner)) {
            // What cannot be taken away stays: it is in nobody's way.
            let _ = take_away(folder, &entry.path());
        }
    }
}

/// The number of the process in a name.
fn owner(name: &str) -> Option<u32> {
    let (number, _) = name.strip_prefix(BEGIN)?.split_once('-')?;
    number.parse().ok()
}

/// Whether a process is alive, as far as this system says; where it does not, the lock has to.
fn is_alive(number: u32) -> bool {
    number == std::process::id()
        || cfg!(target_os = "linux") && Path::new(&format!("/proc/{number}")).exists()
}

fn take_away(folder: &Path, part: &Path) -> io::Result<()> {
    let metadata = fs::symlink_metadata(part)?;
    if !metadata.is_dir() && !metadata.is_file() {
        return Ok(());
    }
    if cfg!(unix) {
        let held = File::open(part)?;
        // Another machine's process may own it, on a drive that both have.
        held.try_lock().map_err(io::Error::from)?;
    }
    if metadata.is_file() {
        return fs::remove_file(part);
    }
    put_back(folder, part)?;
    fs::remove_dir_all(part)
}

/// Puts the folder back that a process had taken away when it was killed, unless another stands there.
fn put_back(folder: &Path, part: &Path) -> io::Result<()> {
    let earlier = part.join(EARLIER);
    if !earlier.is_dir() {
        return Ok(());
    }
    let name = fs::read_to_string(part.join(PLACE))?;
    let mut parts = Path::new(&name).components();
    let is_name = matches!(
        (parts.next(), parts.next()),
        (Some(std::path::Component::Normal(_)), None)
    );
    let place = folder.join(&name);
    if is_name && fs::symlink_metadata(&place).is_err() {
        return fs::rename(&earlier, &place);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number of a process that has ended.
    fn dead() -> u32 {
        let mut child = std::process::Command::new(std::env::current_exe().unwrap());
        let mut child = child
            .arg("--list")
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        child.wait().unwrap();
        child.id()
    }

    #[test]
    fn what_a_dead_process_left_goes_and_what_a_living_one_has_stays() {
        let home = tempfile::tempdir().unwrap();
        let (dead, own) = (dead(), std::process::id());
        let name = |number: u32, end: &str| home.path().join(format!("{BEGIN}{number}-{end}{END}"));
        fs::write(name(dead, "file"), "half").unwrap();
        fs::create_dir_all(name(dead, "folder").join("in/it")).unwrap();
        fs::write(name(own, "file"), "half").unwrap();
        let locked = File::create(name(dead, "elsewhere")).unwrap();
        hold(&locked);
        for foreign in [
            ".rigproof-notes.txt",
            "rigproof-1-x.part",
            ".rigproof-x.part",
        ] {
            fs::write(home.path().join(foreign), "mine").unwrap();
        }
        sweep_now(home.path());
        let left: BTreeSet<_> = fs::read_dir(home.path())
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect();
        assert!(!left.contains(&name(dead, "file")) && !left.contains(&name(dead, "folder")));
        assert!(left.contains(&name(own, "file")) && left.contains(&name(dead, "elsewhere")));
        assert_eq!(left.len(), 5);
    }

    #[test]
    fn the_earlier_folder_comes_back_unless_another_stands_there() {
        for is_taken in [false, true] {
            let home = tempfile::tempdir().unwrap();
            let part = home.path().join(format!("{BEGIN}{}-x{END}", dead()));
            fs::create_dir_all(part.join(EARLIER)).unwrap();
            fs::write(part.join(EARLIER).join("a.csv"), "old").unwrap();
            fs::write(part.join(PLACE), "out").unwrap();
            if is_taken {
                fs::create_dir(home.path().join("out")).unwrap();
            }
            sweep_now(home.path());
            assert_eq!(home.path().join("out/a.csv").exists(), !is_taken);
            assert!(!part.exists());
        }
    }

    #[test]
    fn a_name_that_leads_away_is_no_place() {
        let home = tempfile::tempdir().unwrap();
        fs::create_dir(home.path().join("in")).unwrap();
        let part = home.path().join(format!("in/{BEGIN}{}-x{END}", dead()));
        fs::create_dir_all(part.join(EARLIER)).unwrap();
        fs::write(part.join(PLACE), "../out").unwrap();
        sweep_now(&home.path().join("in"));
        assert!(!home.path().join("out").exists());
    }
}
