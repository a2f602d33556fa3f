//! This file plants the mutants: for each, the rig's own selection is copied with one change, so that no mutant can drift from what it mutates.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// What is copied, below `impl/src`; it refers to the rest of `impl` where it stands.
const TREE: [&str; 4] = ["vector.rs", "select.rs", "guard.rs", "plant/backlash.rs"];
const FOLDERS: [&str; 3] = ["select", "guard", "plant/backlash"];

fn main() -> Result<()> {
    let source = Path::new("../impl/src");
    let out = PathBuf::from(std::env::var("OUT_DIR")?).join("planted");
    println!("cargo::rerun-if-changed=mutants.toml");
    println!("cargo::rerun-if-changed=../impl/src");
    let mut files: Vec<String> = TREE.map(str::to_owned).into();
    for folder in FOLDERS {
        walk(source, folder, &mut files)?;
    }
    let table: Table = fs::read_to_string("mutants.toml")?.parse()?;
    let mutants = table
        .get("mutant")
        .and_then(Value::as_array)
        .ok_or("mutants.toml: no [[mutant]]")?;
    if out.exists() {
        fs::remove_dir_all(&out)?;
    }
    let (mut modules, mut entries) = (String::new(), String::new());
    for mutant in mutants {
        let text = |key: &str| {
            let value = mutant.get(key).and_then(Value::as_str);
            value.ok_or_else(|| format!("mutants.toml: `{key}` is missing in {mutant}"))
        };
        let (name, file, from, to) = (text("name")?, text("file")?, text("from")?, text("to")?);
        let folder = out.join(name);
        let mut planted = false;
        for path in &files {
            let mut content = fs::read_to_string(source.join(path))?;
            if path == file {
                if content.matches(from).count() != 1 {
                    return Err(
                        format!("mutants.toml: {name}: `{from}` is not once in {file}").into(),
                    );
                }
                content = content.replacen(from, to, 1);
                planted = true;
            }
            let target = folder.join(path);
            fs::create_dir_all(target.parent().ok_or("no folder")?)?;
            fs::write(target, relocate(&content, name))?;
        }
        if !planted {
            return Err(format!("mutants.toml: {name}: {file} is not copied").into());
        }
        fs::write(
            folder.join("mod.rs"),
            "pub mod guard;\npub mod plant {\n    pub mod backlash;\n}\npub mod select;\npub mod vector;\n",
        )?;
        // Only what the change can reach is asked: a mutant of the guard cannot touch selection, nor the other way round.
        let room = match file {
            _ if file.starts_with("guard") => "guard",
            _ if file.starts_with("plant/backlash") => "plant::backlash",
            _ => "select",
        };
        let place = folder.join("mod.rs");
        modules += &format!("#[path = {place:?}]\npub mod {name};\n");
        entries += &format!(
            "Planted {{ name: {name:?}, file: {file:?}, from: {from:?}, to: {to:?}, claims: {name}::{room}::proofs::claims::<C>().into_iter().collect() }},\n"
        );
    }
    fs::write(out.join("planted.rs"), listed(&modules, &entries)?)?;
    Ok(())
}

/// The list of the mutants. As many copies of the claims are compiled only where they are examined: what checks and tests builds none.
fn listed(modules: &str, entries: &str) -> Result<String> {
    let is_optimised = std::env::var("PROFILE")? == "release";
    let (modules, entries) = match is_optimised {
        true => (modules, entries),
        false => ("", ""),
    };
    Ok(format!(
        "/// Whether this build has the mutants: an optimised one has.\npub const IS_PLANTED: bool = {is_optimised};\n{modules}\n\
         /// Every mutant with its claims.\npub fn planted<C: Checker>() -> Vec<Planted<C>> {{ vec![{entries}] }}\n"
    ))
}

/// Every source below a folder of `impl/src`.
fn walk(source: &Path, folder: &str, files: &mut Vec<String>) -> Result<()> {
    for entry in fs::read_dir(source.join(folder))? {
        let entry = entry?;
        let name = entry
            .file_name()
            .into_string()
            .map_err(|_| "a name is not UTF-8")?;
        let path = format!("{folder}/{name}");
        if entry.file_type()?.is_dir() {
            walk(source, &path, files)?;
        } else {
            files.push(path);
        }
    }
    files.sort();
    Ok(())
}

/// The source as it stands in the mutant: its own selection, vectors and claims, and the rest of `impl`; without tests.
fn relocate(content: &str, name: &str) -> String {
    content
        .replace("#[cfg(any(kani, feature = \"claims\"))]\n", "")
        .replace("#[cfg(test)]", "#[cfg(any())]")
        .replace("crate::", "rigproof_impl::")
        .replace(
            "rigproof_impl::guard",
            &format!("crate::planted::{name}::guard"),
        )
        .replace(
            "rigproof_impl::select",
            &format!("crate::planted::{name}::select"),
        )
        .replace(
            "rigproof_impl::vector",
            &format!("crate::planted::{name}::vector"),
        )
}
