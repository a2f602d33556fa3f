//! This file says which licences the packages may have that are built into the program and its tests, where they come from, and which stand there in two versions.

use std::collections::BTreeMap;
use std::process::Command;

use serde_json::Value;

use crate::tidy::assert_tidy;
use crate::tidy::workspace::root;

/// Where packages come from; a room has no source.
const SOURCE: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Licences as packages write them. Each can be kept by naming it; one that is not here has to be read before it is added.
const LICENCES: [&str; 22] = [
    "(Apache-2.0 OR MIT) AND BSD-3-Clause",
    "(MIT OR Apache-2.0) AND Unicode-3.0",
    "0BSD OR MIT OR Apache-2.0",
    "Apache-2.0",
    "Apache-2.0 / MIT",
    "Apache-2.0 OR BSD-3-Clause",
    "Apache-2.0 OR BSL-1.0",
    "Apache-2.0 OR MIT",
    "Apache-2.0 WITH LLVM-exception OR Apache-2.0 OR MIT",
    "Apache-2.0/MIT",
    "BSD-2-Clause OR Apache-2.0 OR MIT",
    "BSD-3-Clause",
    "ISC",
    "MIT",
    "MIT OR Apache-2.0",
    "MIT OR Zlib OR Apache-2.0",
    "MIT-0",
    "MIT/Apache-2.0",
    "Unlicense OR MIT",
    "Unlicense/MIT",
    "Zlib",
    "Zlib OR Apache-2.0 OR MIT",
];

/// Packages that name no licence but hold its text: it was read.
const READ: [(&str, &str); 1] = [("cobyla", "MIT")];

/// Packages in more than one version, and why.
const TWICE: [(&str, &str); 7] = [
    (
        "bit-set",
        "tests: `fancy-regex` of `jsonschema` and `proptest` want one each",
    ),
    ("bit-vec", "with `bit-set`"),
    (
        "getrandom",
        "tests: the older one is that of `ahash`, for `jsonschema`",
    ),
    (
        "glam",
        "`nalgebra` can turn into eighteen of them; none is built",
    ),
    (
        "syn",
        "macros, some of them older: nothing of either is in the program",
    ),
    (
        "toml_datetime",
        "`toml_edit`, of a macro that is not built, wants a newer one than `toml`",
    ),
    ("winnow", "`toml` and its own `toml_parser` want one each"),
];

/// Every package that this platform's build may need, as cargo sees it.
fn packages() -> Vec<Value> {
    let mut command = Command::new(env!("CARGO"));
    let words = ["metadata", "--locked", "--offline", "--format-version", "1"];
    command.args(words).current_dir(root());
    command.args(["--filter-platform", "x86_64-unknown-linux-gnu"]);
    let answer = command.output().unwrap();
    let said = String::from_utf8_lossy(&answer.stderr);
    assert!(answer.status.success(), "{said}");
    let metadata: Value = serde_json::from_slice(&answer.stdout).unwrap();
    let nodes = metadata["resolve"]["nodes"].as_array().unwrap();
    let needed: Vec<&Value> = nodes.iter().map(|node| &node["id"]).collect();
    let all = metadata["packages"].as_array().unwrap();
    let all = all
        .iter()
        .filter(|package| needed.contains(&&package["id"]));
    all.cloned().collect()
}

fn text<'a>(package: &'a Value, key: &str) -> Option<&'a str> {
    package.get(key).and_then(Value::as_str)
}

/// What is wrong with these packages.
fn violations(packages: &[Value]) -> Vec<String> {
    let mut violations = Vec::new();
    let mut versions: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for package in packages {
        let (Some(name), Some(version)) = (text(package, "name"), text(package, "version")) else {
            violations.push(format!("{package}: a package without a name or a version"));
            continue;
        };
        versions.entry(name).or_default().push(version);
        let licence = text(package, "license");
        let is_read = READ.iter().any(|(read, _)| *read == name);
        if !licence.map_or(is_read, |licence| LICENCES.contains(&licence)) {
            let licence = licence.unwrap_or("none");
            violations.push(format!(
                "{name} {version}: its licence is `{licence}`: read it, and add it to tests/tests/tidy/packages.rs if it can be kept"
            ));
        }
        let source = text(package, "source");
        if source.is_some_and(|source| source != SOURCE) {
            violations.push(format!("{name} {version}: it does not come from crates.io"));
        }
    }
    for (name, all) in &versions {
        let is_known = TWICE.iter().any(|(known, _)| known == name);
        if is_known != (all.len() > 1) {
            violations.push(format!(
                "{name}: {}: keep tests/tests/tidy/packages.rs true to it",
                all.join(" and ")
            ));
        }
    }
    violations
}

// Which packages another system needs, cargo knows only where they were fetched.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[test]
fn packages_have_known_licences_one_source_and_one_version() {
    let packages = packages();
    assert!(packages.len() > 200, "{}", packages.len());
    assert_tidy("packages", violations(&packages));
}

#[test]
fn a_licence_that_nobody_read_a_source_and_a_second_version_are_noticed() {
    let package = |name: &str, version: &str, licence: Value, source: &str| serde_json::json!({ "name": name, "version": version, "license": licence, "source": source });
    let mut packages = vec![
        package("one", "1.0.0", "MIT".into(), SOURCE),
        package("cobyla", "1.0.4", Value::Null, SOURCE),
    ];
    // What stands twice by name has to.
    for (name, _) in TWICE {
        packages
            .extend(["1.0.0", "2.0.0"].map(|version| package(name, version, "MIT".into(), SOURCE)));
    }
    assert_eq!(violations(&packages), [""; 0]);
    packages.push(package("two", "1.0.0", "GPL-3.0-only".into(), SOURCE));
    packages.push(package("three", "1.0.0", Value::Null, SOURCE));
    packages.push(package(
        "four",
        "1.0.0",
        "MIT".into(),
        "git+https://example.org/four",
    ));
    packages.push(package("one", "1.1.0", "MIT".into(), SOURCE));
    let found = violations(&packages);
    assert_eq!(found.len(), 4, "{found:?}");
    packages.retain(|package| package["version"] != "2.0.0");
    assert_eq!(violations(&packages).len(), 4 + TWICE.len());
}
