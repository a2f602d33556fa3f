//! This file kills verbs that write before chosen system calls: what was there or what is to be there stands then, and the next run tidies up.
#![cfg(target_os = "linux")]

mod table;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU64, Ordering};

use ed25519_compact::{KeyPair, PublicKey};

use crate::desk::Desk;
use table::{Kind, Writes};

/// How many kills each verb gets in a usual test; `RIGPROOF_KILLS` says another number.
const EACH: u64 = 5;

/// What stands at a place: every file with its bytes.
type Stands = BTreeMap<PathBuf, Vec<u8>>;

/// How many kills there were so far, of all verbs.
static ALL: AtomicU64 = AtomicU64::new(0);

/// The killer, built; `None` without a C compiler or where processes are not traced.
fn killer(desk: &Desk) -> Option<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/verbs/killer.c");
    let program = desk.path("killer");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let built = Command::new(compiler)
        .arg("-O1")
        .arg("-o")
        .args([&program, &source])
        .status();
    let Ok(built) = built else {
        println!("no C compiler: nothing was killed");
        return None;
    };
    assert!(built.success(), "the killer does not compile");
    let traced = Command::new(&program)
        .args(["0", "/bin/true"])
        .status()
        .unwrap();
    if !traced.success() {
        println!("this system lets no process trace another: nothing was killed");
        return None;
    }
    Some(program)
}

/// A folder with what a verb reads, and with what it writes over.
fn desk(writes: &Writes) -> Desk {
    let desk = Desk::new();
    (writes.put)(&desk);
    let lines = writes.ready.iter().chain([&writes.old]);
    for line in lines.filter(|line| !line.is_empty()) {
        let answer = desk.rigproof(line);
        assert!(
            answer.status.code().is_some_and(|code| code < 2),
            "{line}: {answer:?}"
        );
    }
    desk
}

/// The same folder once more.
fn copied(from: &Desk) -> Desk {
    let to = Desk::new();
    let mut left = vec![PathBuf::new()];
    while let Some(part) = left.pop() {
        for entry in fs::read_dir(from.path("").join(&part)).unwrap().flatten() {
            let part = part.join(entry.file_name());
            let place = to.path("").join(&part);
            match entry.path().is_dir() {
                true => {
                    fs::create_dir(&place).unwrap();
                    left.push(part);
                }
                false => drop(fs::copy(entry.path(), place).unwrap()),
            }
        }
    }
    to
}

/// What stands at a place, parts left out.
fn stands(place: &Path) -> Stands {
    let mut all = BTreeMap::new();
    let mut left = vec![place.to_path_buf()];
    while let Some(path) = left.pop() {
        let is_part = path
            .file_name()
            .is_some_and(|name| name.to_string_lossy().ends_with(".part"));
        match path.is_dir() {
            _ if is_part => {}
            true => left.extend(
                fs::read_dir(&path)
                    .unwrap()
                    .map(|entry| entry.unwrap().path()),
            ),
            false => {
                if let Ok(bytes) = fs::read(&path) {
                    all.insert(path.strip_prefix(place).unwrap().to_path_buf(), bytes);
                }
            }
        }
    }
    all
}

/// Names of parts below a folder.
fn parts(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if entry.file_name().to_string_lossy().ends_with(".part") {
            found.push(path);
        } else if path.is_dir() {
            found.extend(parts(&path));
        }
    }
    found
}

fn killed(killer: &Path, desk: &Desk, line: &str, at: u64) -> (i32, String) {
    let mut command = Command::new(killer);
    command
        .arg(at.to_string())
        .arg(env!("CARGO_BIN_EXE_rigproof"));
    let answer = command
        .args(line.split_whitespace())
        .current_dir(desk.path(""))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&answer.stderr).into_owned();
    (answer.status.code().unwrap_or(-1), said)
}

/// Whether a kill may leave this.
fn may_stand(kind: Kind, left: &Stands, old: &Stands, new: &Stands) -> bool {
    match kind {
        Kind::Whole => left == old || left == new,
        Kind::Files => {
            let is_one = |(name, own)| [old.get(name), new.get(name)].contains(&Some(own));
            left.iter().all(is_one) && old.keys().all(|name| left.contains_key(name))
        }
        Kind::Campaign => {
            let verdict = Path::new("certificate.json");
            left.get(verdict)
                .is_none_or(|own| [new.get(verdict), old.get(verdict)].contains(&Some(own)))
        }
        Kind::Key => left == old || is_key(left, 1) || is_key(left, 2),
    }
}

/// Whether what stands is so many halves of one key, the secret one first.
fn is_key(left: &Stands, halves: usize) -> bool {
    let text = |name: &str| core::str::from_utf8(left.get(Path::new(name))?).ok();
    let secret = text("own.pem").and_then(|own| KeyPair::from_pem(own).ok());
    let public = text("own.pem.pub").and_then(|own| PublicKey::from_pem(own).ok());
    let is_same = public.is_none_or(|public| secret.as_ref().is_some_and(|own| own.pk == public));
    left.len() == halves && secret.is_some() && is_same && (halves < 2 || public.is_some())
}

/// Kills a verb before one of its calls, and runs it again.
fn kill(writes: &Writes, killer: &Path, [old, new]: [&Stands; 2], desk: &Desk, at: u64) {
    let place = desk.path(writes.out);
    let (code, said) = killed(killer, desk, writes.new, at);
    let named = format!("{} at {at}", writes.name);
    // Threads make a call more or less; then it came to its end.
    assert!([99, 0, 1].contains(&code), "{named}: {code} {said}");
    let left = stands(&place);
    let names = left.keys();
    assert!(
        may_stand(writes.kind, &left, old, new),
        "{named}: {names:?}"
    );
    let is_new = |left: &Stands| match writes.kind {
        Kind::Key => is_key(left, 2),
        _ => left == new,
    };
    if code == 99 {
        let again = desk.rigproof(writes.new);
        let code = again.status.code();
        // What was there before the kill is not made again where a verb refuses to write over it.
        let is_refused = code == Some(3) && is_new(&left);
        assert!(
            is_refused || code.is_some_and(|code| code < 2),
            "{named}: {again:?}"
        );
    }
    assert!(is_new(&stands(&place)), "{named}: not what is to be there");
    let left = parts(&desk.path(""));
    let is_refused = writes.old.is_empty() && matches!(writes.kind, Kind::Whole | Kind::Key);
    assert!(left.is_empty() || is_refused, "{named}: {left:?}");
}

/// Kills a verb at calls spread over all that it makes.
fn kills(writes: &Writes, most: u64) {
    let ready = desk(writes);
    let first = copied(&ready);
    let Some(killer) = killer(&first) else {
        return;
    };
    let old = stands(&ready.path(writes.out));
    let (code, said) = killed(&killer, &first, writes.new, 0);
    assert!((0..=1).contains(&code), "{}: {code} {said}", writes.name);
    let new = stands(&first.path(writes.out));
    let calls = said.lines().find_map(|line| line.strip_prefix("calls: "));
    let calls: u64 = calls.unwrap().parse().unwrap();
    assert!(calls >= 3, "{}: {calls}", writes.name);
    let count = calls.min(most);
    for k in 0..count {
        let at = 1 + k * (calls - 1) / (count - 1).max(1);
        kill(writes, &killer, [&old, &new], &copied(&ready), at);
    }
    let all = ALL.fetch_add(count, Ordering::Relaxed) + count;
    println!(
        "{:<20} {count} kills before {calls} calls; {all} so far",
        writes.name
    );
}

/// How many kills a verb gets: 5, or what `RIGPROOF_KILLS` says.
fn asked() -> Option<u64> {
    let asked = std::env::var("RIGPROOF_KILLS").ok();
    asked.map(|text| text.parse().unwrap())
}

/// A test a verb: a kill leaves what was or what is to be, and the next run tidies up.
macro_rules! killed_anywhere {
    ($($name:ident: $writes:ident, $usual:expr;)*) => {
        $(#[test]
        fn $name() {
            if let Some(most) = asked().or($usual) {
                kills(&table::$writes, most);
            }
        })*
    };
}

killed_anywhere! {
    simulate: SIMULATE, Some(EACH);
    design: DESIGN, Some(EACH);
    reproduce: REPRODUCE, Some(EACH);
    convert: CONVERT, Some(EACH);
    inspect: INSPECT, Some(EACH);
    identify: IDENTIFY, Some(EACH);
    blind_make: MAKE, Some(EACH);
    blind_trial: TRIAL, Some(EACH);
    blind_trial_page: TRIAL_PAGE, Some(EACH);
    new: NEW, Some(EACH);
    man: MAN, Some(EACH);
    golden_export: EXPORT, Some(EACH);
    golden_regenerate: REGENERATE, Some(EACH);
    certify: CERTIFY, Some(EACH);
    certify_merge: MERGE, Some(EACH);
    certify_sign: SIGN, Some(EACH);
    certify_monitor: MONITOR, Some(EACH);
    certify_key: MAKE_KEY, Some(EACH);
    // These take long under the killer.
    diagnose: DIAGNOSE, None;
    demo: DEMO, None;
}
