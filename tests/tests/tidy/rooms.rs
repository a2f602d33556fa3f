//! This file says which room may depend on which.

use std::fs;

use toml::{Table, Value};

use crate::tidy::assert_tidy;
use crate::tidy::workspace::root;

/// Every room, built or coming, and the rooms it may depend on. A room that is not here has no place.
const ROOMS: [(&str, &[&str]); 16] = [
    ("spec", &[]),
    ("model", &["spec"]),
    ("impl", &["spec"]),
    ("impl/c", &["spec", "impl"]),
    ("trace", &["spec"]),
    ("golden", &["spec", "model", "trace"]),
    ("proofs", &["spec", "model", "impl"]),
    ("diagnose", &["spec", "model", "trace"]),
    ("blind", &["spec", "trace"]),
    ("experiments", &["spec", "model", "trace"]),
    ("certify", &["spec", "model", "impl", "trace"]),
    ("certify/host", &["spec", "impl", "impl-c", "certify"]),
    ("report", &["spec", "model", "trace", "diagnose", "certify"]),
    (
        "cli",
        &[
            "spec",
            "model",
            "impl",
            "trace",
            "golden",
            "diagnose",
            "blind",
            "experiments",
            "certify",
            "certify-host",
            "report",
        ],
    ),
    (
        "tests",
        &[
            "spec",
            "model",
            "impl",
            "trace",
            "golden",
            "proofs",
            "diagnose",
            "blind",
            "experiments",
            "certify",
            "report",
            "cli",
        ],
    ),
    ("python", &["trace"]),
];

#[test]
fn rooms_depend_in_one_direction() {
    let mut violations = Vec::new();
    for room in members() {
        let Some((_, allowed)) = ROOMS.iter().find(|(name, _)| *name == room) else {
            violations.push(format!(
                "Cargo.toml: `{room}` is no room: name it in tests/tests/tidy/rooms.rs with what it may depend on"
            ));
            continue;
        };
        for dependency in against(allowed, &dependencies(&room)) {
            let advice = format!("`{room}` may depend on {allowed:?} only");
            violations.push(forbidden(&room, &dependency, &advice));
        }
    }
    assert_tidy("room edges", violations);
}

/// The rooms among these dependencies that are not allowed.
fn against(allowed: &[&str], dependencies: &[String]) -> Vec<String> {
    let room = |name: &String| name.strip_prefix("rigproof-").map(str::to_owned);
    let rooms = dependencies
        .iter()
        .filter(|name| room(name).is_some_and(|room| !allowed.contains(&room.as_str())));
    rooms.cloned().collect()
}

#[test]
fn a_forbidden_edge_is_noticed() {
    let dependencies = ["libm", "rigproof-spec", "rigproof-model"].map(str::to_owned);
    assert_eq!(against(&["spec"], &dependencies), ["rigproof-model"]);
    assert!(against(&["spec", "model"], &dependencies).is_empty());
    let advice = forbidden("model", "libm", "an example");
    assert!(advice.starts_with("model/Cargo.toml:") && advice.ends_with("`libm`: an example"));
}

#[test]
fn spec_depends_on_nothing() {
    let violations = dependencies("spec")
        .iter()
        .map(|name| forbidden("spec", name, "spec is `no_std` and stands alone"))
        .collect();
    assert_tidy("dependencies of spec", violations);
}

/// The rooms with `unsafe`, in blocks that say why they are sound: where C calls, and where C is called.
const UNSAFE_ROOMS: [&str; 2] = ["impl/c", "certify/host"];

#[test]
fn unsafe_stands_in_the_rooms_of_c_only() {
    let workspace = manifest("Cargo.toml");
    let of_all = workspace["workspace"]["lints"]["rust"]["unsafe_code"].as_str();
    assert_eq!(of_all, Some("forbid"));
    let violations = members()
        .iter()
        .filter_map(|room| trusted(room, &manifest(&format!("{room}/Cargo.toml"))))
        .collect();
    assert_tidy("rooms with unsafe", violations);
}

/// What is wrong with a room's lints, if anything.
fn trusted(room: &str, manifest: &Table) -> Option<String> {
    let nothing = Value::Boolean(false);
    let lints = manifest.get("lints").unwrap_or(&nothing);
    let says = |group: &str, lint: &str| {
        let lint = lints.get(group).and_then(|group| group.get(lint));
        lint.and_then(Value::as_str) == Some("deny")
    };
    let fine = match UNSAFE_ROOMS.contains(&room) {
        true => says("rust", "unsafe_code") && says("clippy", "undocumented_unsafe_blocks"),
        false => lints.get("workspace").and_then(Value::as_bool) == Some(true),
    };
    (!fine).then(|| {
        format!("{room}/Cargo.toml: take the workspace's lints, or be named in tests/tests/tidy/rooms.rs and deny unsafe code that does not say why")
    })
}

#[test]
fn a_room_that_allows_itself_unsafe_is_noticed() {
    let read = |text: &str| -> Table { text.parse().unwrap() };
    let inherits = read("[lints]\nworkspace = true\n");
    let own = read(
        "[lints.rust]\nunsafe_code = \"deny\"\n[lints.clippy]\nundocumented_unsafe_blocks = \"deny\"\n",
    );
    let lax = read("[lints.rust]\nunsafe_code = \"deny\"\n");
    assert!(trusted("model", &inherits).is_none() && trusted("impl/c", &own).is_none());
    for (room, manifest) in [("model", &own), ("impl/c", &lax), ("impl/c", &inherits)] {
        assert!(trusted(room, manifest).is_some(), "{room}");
    }
}

#[test]
fn every_version_stands_in_the_root() {
    let mut violations = Vec::new();
    for room in members() {
        for name in with_versions(dependency_entries(&room)) {
            violations.push(forbidden(
                &room,
                &name,
                "write `workspace = true`, and the version in the root Cargo.toml",
            ));
        }
    }
    assert_tidy("versions outside the root", violations);
}

/// Dependencies that do not inherit what the root says of them.
fn with_versions(entries: Vec<(String, Value)>) -> Vec<String> {
    let inherits = |value: &Value| value.get("workspace").and_then(Value::as_bool) == Some(true);
    entries
        .into_iter()
        .filter(|(_, value)| !inherits(value))
        .map(|(name, _)| name)
        .collect()
}

#[test]
fn every_dependency_has_its_reason() {
    let reasons = fs::read_to_string(root().join("docs/dependencies.md")).unwrap();
    let violations = without_reason(&manifest("Cargo.toml"), &reasons);
    assert_tidy("dependencies without a reason", violations);
}

fn without_reason(manifest: &Table, reasons: &str) -> Vec<String> {
    let names = manifest["workspace"]["dependencies"]
        .as_table()
        .unwrap()
        .keys();
    names
        .filter(|name| !name.starts_with("rigproof-") && !reasons.contains(&format!("`{name}`")))
        .map(|name| format!("Cargo.toml: `{name}`: say why in docs/dependencies.md"))
        .collect()
}

#[test]
fn a_dependency_with_a_version_or_without_a_reason_is_noticed() {
    let read = |text: &str| -> Table { text.parse().unwrap() };
    let room = read(
        "[dependencies]\nlibm.workspace = true\n[dev-dependencies]\nrand = \"0.9\"\n\
         [target.'cfg(unix)'.dependencies]\nhdf5 = { version = \"0.47\", package = \"hdf5-pure\" }\n",
    );
    let entries = entries(&room);
    assert_eq!(entries.len(), 3);
    assert_eq!(with_versions(entries), ["hdf5", "rand"]);
    let root =
        read("[workspace.dependencies]\nlibm = \"0.2\"\nrand = \"0.9\"\nrigproof-spec = \"0.1\"\n");
    assert_eq!(without_reason(&root, "`libm` computes sines.").len(), 1);
    assert_eq!(against(&[], &["rigproof-model".to_owned()]).len(), 1);
}

fn forbidden(room: &str, dependency: &str, advice: &str) -> String {
    let path = format!("{room}/Cargo.toml");
    let text = fs::read_to_string(root().join(&path)).unwrap();
    let line = text
        .lines()
        .position(|line| line.starts_with(dependency) || line.ends_with(&format!(".{dependency}]")))
        .map_or(1, |index| index + 1);
    format!("{path}:{line}: `{dependency}`: {advice}")
}

/// The folders of the workspace's packages.
pub fn members() -> Vec<String> {
    let manifest = manifest("Cargo.toml");
    let members = manifest["workspace"]["members"].as_array().unwrap();
    members
        .iter()
        .map(|member| member.as_str().unwrap().to_owned())
        .collect()
}

/// Every package a room names, under whichever heading of its manifest; a renamed one by its own name.
fn dependencies(room: &str) -> Vec<String> {
    let entries = dependency_entries(room).into_iter();
    entries
        .map(
            |(key, value)| match value.get("package").and_then(Value::as_str) {
                Some(package) => package.to_owned(),
                None => key,
            },
        )
        .collect()
}

fn dependency_entries(room: &str) -> Vec<(String, Value)> {
    entries(&manifest(&format!("{room}/Cargo.toml")))
}

fn entries(manifest: &Table) -> Vec<(String, Value)> {
    let headings = ["dependencies", "dev-dependencies", "build-dependencies"];
    headings
        .into_iter()
        .flat_map(|heading| entries_under(manifest, heading))
        .collect()
}

/// What stands under this heading, on whichever platform.
pub fn entries_under(manifest: &Table, heading: &str) -> Vec<(String, Value)> {
    let targets = manifest.get("target").and_then(Value::as_table);
    let targets = targets
        .into_iter()
        .flat_map(Table::values)
        .filter_map(Value::as_table);
    let named = targets
        .chain([manifest])
        .filter_map(|table| table.get(heading).and_then(Value::as_table));
    named.flat_map(Table::clone).collect()
}

pub fn manifest(path: &str) -> Table {
    let text = fs::read_to_string(root().join(path)).unwrap();
    text.parse()
        .unwrap_or_else(|error| panic!("{path}: {error}"))
}
