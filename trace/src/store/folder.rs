//! This file writes an output folder beside its place and renames it when it is whole.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::{builder, parent, read_text, sync_folder, write_aside};
use crate::error::TraceError;

/// The file that marks a folder as written by this program: it lists the files the program wrote there.
const MARKER: &str = ".rigproof";

/// An output folder that is being written; dropped before [`Folder::finish`], it leaves nothing behind.
#[derive(Debug)]
pub struct Folder {
    target: PathBuf,
    aside: TempDir,
}

impl Folder {
    /// Begins a folder that will stand at `target`.
    ///
    /// # Errors
    /// Something stands there that is neither an empty folder nor one that holds only what this program wrote, or
    /// the system refuses.
    pub fn begin(target: &Path) -> Result<Folder, TraceError> {
        check_replaceable(target)?;
        let refused = || TraceError::io("write", target);
        let aside = builder().make_dir_in(&parent(target)).map_err(refused())?;
        Ok(Folder {
            target: target.to_path_buf(),
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
        let list: Vec<String> = list.into_iter().map(|name| name + "\n").collect();
        self.write(MARKER, list.concat().as_bytes())?;
        self.place()
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
        self.place()
    }

    fn place(self) -> Result<(), TraceError> {
        let refused = || TraceError::io("write", &self.target);
        check_replaceable(&self.target)?;
        let parent = parent(&self.target);
        // The earlier folder waits beside the new one, to come back if the rename fails.
        let waiting = builder().make_dir_in(&parent).map_err(refused())?;
        let earlier = waiting.path().join("earlier");
        let had_earlier = self.target.exists();
        if had_earlier {
            fs::rename(&self.target, &earlier).map_err(refused())?;
        }
        if let Err(error) = fs::rename(self.aside.path(), &self.target) {
            if had_earlier {
                fs::rename(&earlier, &self.target).map_err(refused())?;
            }
            return Err(refused()(error));
        }
        sync_folder(&parent).map_err(refused())
    }
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
    let ours: BTreeSet<&str> = text.lines().chain([MARKER]).collect();
    match present.iter().find(|name| !ours.contains(name.as_str())) {
        Some(foreign) => refused(format!(
            "the folder holds `{foreign}`, which this program did not write; name another folder or empty this one"
        )),
        None => Ok(()),
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
    fn an_unfinished_folder_leaves_nothing() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::begin(&home.path().join("out")).unwrap();
        folder.write("a.csv", b"1.5\n").unwrap();
        drop(folder);
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
    }
}
