//! This file writes an output folder beside its place and renames it when it is whole.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use tempfile::TempDir;

use super::part::{self, EARLIER, PLACE, builder};
use super::{parent, read_text, sync_folder, write_aside};
use crate::error::TraceError;

/// The file that marks a folder as written by this program: it lists the files the program wrote there.
const MARKER: &str = ".rigproof";

/// An output folder that is being written; dropped before [`Folder::finish`], it leaves nothing behind.
#[derive(Debug)]
pub struct Folder {
    target: PathBuf,
    aside: TempDir,
    /// Shows others that this process lives.
    _held: Option<File>,
}

impl Folder {
    /// Begins a folder that will stand at `target`.
    ///
    /// # Errors
    /// Something stands there that is neither an empty folder nor one that holds only what this program wrote, or
    /// the system refuses.
    pub fn begin(target: &Path) -> Result<Folder, TraceError> {
        // First: it may put back what stood there.
        part::sweep(&parent(target));
        check_replaceable(target)?;
        let refused = || TraceError::io("write", target);
        let aside = builder().make_dir_in(&parent(target)).map_err(refused())?;
        Ok(Folder {
            target: target.to_path_buf(),
            _held: held(aside.path()),
            aside,
        })
    }

    /// Writes one file of the folder; `name` may hold subfolders, separated by `/`.
    ///
    /// # Errors
    /// The system refuses.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), TraceError> {
        let path = self.aside.path().join(name);
        fs::create_dir_all(parent(&path))
            .map_err(TraceError::io("write", &self.target.join(name)))?;
        write_aside(&path, bytes)
    }

    /// Puts the folder in its place, and takes an earlier one of this program away.
    ///
    /// # Errors
    /// The place was taken in the meantime, or the system refuses; then nothing has changed.
    pub fn finish(self) -> Result<(), TraceError> {
        let refused = || TraceError::io("write", &self.target);
        let list = files_in(self.aside.path()).map_err(refused())?;
        let mut text = String::new();
        for name in list {
            let sha256 = sha256(&self.aside.path().join(&name)).map_err(refused())?;
            text += &format!("{sha256}  {name}\n");
        }
        self.write(MARKER, text.as_bytes())?;
        self.place(&exchanged)
    }

    /// Puts a new folder in its place for somebody to work in: this program will not take it for its own again.
    ///
    /// # Errors
    /// Anything stands there already, or the system refuses; then nothing has changed.
    pub fn hand_over(self) -> Result<(), TraceError> {
        if self.target.exists() {
            let problem =
                "it is there already, and what is in it may be somebody's work; name a new folder";
            return Err(TraceError::recording(&self.target, problem.to_owned()));
        }
        self.place(&exchanged)
    }

    /// Puts the folder in its place, by an exchange in one step where the system knows one.
    fn place(self, exchange: &dyn Fn(&Path, &Path) -> io::Result<bool>) -> Result<(), TraceError> {
        let refused = || TraceError::io("write", &self.target);
        check_replaceable(&self.target)?;
        let (parent, aside) = (parent(&self.target), self.aside.path());
        if !self.target.exists() {
            fs::rename(aside, &self.target).map_err(refused())?;
        } else if exchange(aside, &self.target).map_err(refused())? {
            // Somebody may have put something there at the last moment: it is not taken away.
            if let Err(problem) = check_replaceable(aside) {
                exchange(aside, &self.target).map_err(refused())?;
                return Err(problem);
            }
        } else {
            self.replace(&parent)?;
        }
        sync_folder(&parent).map_err(refused())
    }

    /// Puts the folder in its place by two renames. The earlier one waits beside it, with its name, to come back if this fails or is killed between them.
    fn replace(&self, parent: &Path) -> Result<(), TraceError> {
        let refused = || TraceError::io("write", &self.target);
        let waiting = builder().make_dir_in(parent).map_err(refused())?;
        let _held = held(waiting.path());
        let earlier = waiting.path().join(EARLIER);
        let name = self.target.file_name().unwrap_or_default();
        write_aside(
            &waiting.path().join(PLACE),
            name.to_string_lossy().as_bytes(),
        )?;
        fs::rename(&self.target, &earlier).map_err(refused())?;
        if let Err(error) = fs::rename(self.aside.path(), &self.target) {
            fs::rename(&earlier, &self.target).map_err(refused())?;
            return Err(refused()(error));
        }
        Ok(())
    }
}

/// A folder that others see to be owned, as long as this is open.
fn held(folder: &Path) -> Option<File> {
    let held = cfg!(unix).then(|| File::open(folder).ok()).flatten();
    held.as_ref().inspect(|held| part::hold(held));
    held
}

/// Exchanges two folders in one step; `false` where the system or the drive knows none.
fn exchanged(one: &Path, other: &Path) -> io::Result<bool> {
    #[cfg(target_os = "linux")]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        use rustix::io::Errno;
        match renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE) {
            Ok(()) => Ok(true),
            Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }
    #[cfg(not(target_os = "linux"))]
    {
        let _ = (one, other);
        Ok(false)
    }
}

/// The SHA-256 of a file, in hexadecimal; of an empty folder that of nothing.
fn sha256(path: &Path) -> io::Result<String> {
    let mut hash = Sha256::new();
    if !path.is_dir() {
        let (mut file, mut some) = (File::open(path)?, vec![0; 1 << 16]);
        loop {
            let count = file.read(&mut some)?;
            match some.get(..count) {
                Some(read) if count > 0 => hash.update(read),
                _ => break,
            }
        }
    }
    Ok(hash
        .finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect())
}

trait MakeFolder {
    fn make_dir_in(&self, parent: &Path) -> io::Result<TempDir>;
}

impl MakeFolder for tempfile::Builder<'_, '_> {
    #[cfg(unix)]
    fn make_dir_in(&self, parent: &Path) -> io::Result<TempDir> {
        use std::os::unix::fs::PermissionsExt;
        let mut builder = self.clone();
        builder
            .permissions(fs::Permissions::from_mode(0o777))
            .tempdir_in(parent)
    }

    #[cfg(not(unix))]
    fn make_dir_in(&self, parent: &Path) -> io::Result<TempDir> {
        self.tempdir_in(parent)
    }
}

fn check_replaceable(target: &Path) -> Result<(), TraceError> {
    let refused = |problem: String| Err(TraceError::recording(target, problem));
    match fs::symlink_metadata(target) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(TraceError::io("write", target)(error)),
        Ok(metadata) if !metadata.is_dir() => {
            return refused(
                "a file stands where the output folder is to be; name another folder".into(),
            );
        }
        Ok(_) => {}
    }
    let present = files_in(target).map_err(TraceError::io("read", target))?;
    if present.is_empty() {
        return Ok(());
    }
    let marker = target.join(MARKER);
    let text = if marker.is_file() {
        read_text(&marker)?
    } else {
        String::new()
    };
    let ours: BTreeMap<&str, Option<&str>> = text.lines().map(listed).collect();
    for name in present.iter().filter(|name| *name != MARKER) {
        let Some(written) = ours.get(name.as_str()) else {
            return refused(format!(
                "the folder holds `{name}`, which this program did not write; name another folder or empty this one"
            ));
        };
        let own = sha256(&target.join(name)).map_err(TraceError::io("read", target))?;
        if written.is_some_and(|written| written != own) {
            return refused(format!(
                "`{name}` in the folder was changed after this program wrote it; name another folder, or take it away"
            ));
        }
    }
    Ok(())
}

/// A line of the marker: the SHA-256, two spaces and the name, or, as earlier programs wrote it, the name alone.
fn listed(line: &str) -> (&str, Option<&str>) {
    match line.split_once("  ") {
        Some((sha256, name)) if sha256.len() == 64 => (name, Some(sha256)),
        _ => (line, None),
    }
}

/// Every file below a folder, by its path from there with `/` between the parts; an empty subfolder counts as a
/// file that ends in `/`, so that it is not taken away unseen.
fn files_in(folder: &Path) -> io::Result<BTreeSet<String>> {
    let mut files = BTreeSet::new();
    let mut folders = vec![(folder.to_path_buf(), String::new())];
    while let Some((folder, prefix)) = folders.pop() {
        let mut empty = true;
        for entry in fs::read_dir(&folder)? {
            let entry = entry?;
            empty = false;
            let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
            if entry.file_type()?.is_dir() {
                folders.push((entry.path(), name + "/"));
            } else {
                files.insert(name);
            }
        }
        if empty && !prefix.is_empty() {
            files.insert(prefix);
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fill(target: &Path, name: &str) -> Result<(), TraceError> {
        let folder = Folder::begin(target)?;
        folder.write(name, b"1.5\n")?;
        folder.finish()
    }

    #[test]
    fn an_earlier_folder_is_replaced_whole() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("out");
        fill(&target, "runs/a.csv").unwrap();
        fill(&target, "b.csv").unwrap();
        let files: Vec<String> = files_in(&target).unwrap().into_iter().collect();
        assert_eq!(files, [".rigproof", "b.csv"]);
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_somebody_else_wrote_stays() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("out");
        fill(&target, "a.csv").unwrap();
        fs::write(target.join("notes.txt"), "mine").unwrap();
        let message = fill(&target, "b.csv").unwrap_err().to_string();
        assert!(
            message.contains("`notes.txt`, which this program did not write"),
            "{message}"
        );
        assert!(target.join("a.csv").exists() && !target.join("b.csv").exists());
        fs::remove_file(target.join("notes.txt")).unwrap();
        fs::create_dir(target.join("plots")).unwrap();
        assert!(fill(&target, "b.csv").is_err());
        let file = home.path().join("file");
        fs::write(&file, "mine").unwrap();
        assert!(fill(&file, "b.csv").is_err());
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 2);
    }

    #[test]
    fn a_file_that_was_edited_stays() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("out");
        fill(&target, "rig.toml").unwrap();
        fill(&target, "rig.toml").unwrap();
        fs::write(target.join("rig.toml"), "1.6\n").unwrap();
        let message = fill(&target, "rig.toml").unwrap_err().to_string();
        assert!(
            message.contains("`rig.toml` in the folder was changed"),
            "{message}"
        );
        assert_eq!(
            fs::read_to_string(target.join("rig.toml")).unwrap(),
            "1.6\n"
        );
        // What was taken away is no work; a folder of an earlier program lists names alone.
        fs::remove_file(target.join("rig.toml")).unwrap();
        fill(&target, "b.csv").unwrap();
        fs::write(target.join(MARKER), "b.csv\n").unwrap();
        fill(&target, "c.csv").unwrap();
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_is_replaced_by_two_renames_where_none_can_be_exchanged() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("out");
        fill(&target, "a.csv").unwrap();
        let folder = Folder::begin(&target).unwrap();
        folder.write("b.csv", b"2.5\n").unwrap();
        folder.place(&|_, _| Ok(false)).unwrap();
        assert!(target.join("b.csv").exists() && !target.join("a.csv").exists());
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_somebody_puts_there_at_the_last_moment_stays() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("out");
        fill(&target, "a.csv").unwrap();
        let folder = Folder::begin(&target).unwrap();
        let late = |one: &Path, other: &Path| {
            // It comes between the look and the exchange; the second exchange undoes the first.
            if !one.join("mine.txt").exists() {
                fs::write(other.join("mine.txt"), "mine")?;
            }
            exchanged(one, other)
        };
        let pair = ["one", "other"].map(|name| home.path().join(name));
        pair.iter().for_each(|own| fs::create_dir(own).unwrap());
        let [one, other] = &pair;
        if !exchanged(one, other).unwrap() {
            println!("passed over: this drive exchanges nothing");
            return;
        }
        assert!(folder.place(&late).is_err());
        assert!(target.join("mine.txt").exists() && target.join("a.csv").exists());
    }

    #[test]
    fn an_unfinished_folder_leaves_nothing() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::begin(&home.path().join("out")).unwrap();
        folder.write("a.csv", b"1.5\n").unwrap();
        drop(folder);
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
    }
}
