//! This file says that a room names no dependency that it does not use.

use std::collections::BTreeSet;

use proc_macro2::TokenTree;
use toml::{Table, Value};

use crate::tidy::assert_tidy;
use crate::tidy::rooms::{entries_under, manifest, members};
use crate::tidy::rust::{inner, parse};
use crate::tidy::workspace::{Text, sources};

/// Packages that are built by hand, no members of the workspace.
const APART: [&str; 3] = ["docs/mutants", "trace/fuzz", "certify/fuzz"];

/// Dependencies whose use no source shows: package, dependency, why it stands there.
const UNSEEN: [(&str, &str, &str); 6] = [
    (
        "cli",
        "once_cell",
        "with the features that the Python package wants of it, so that what both need is compiled once (decision 0217)",
    ),
    ("cli", "syn", "the same, of macros"),
    (
        "proofs",
        "rigproof-spec",
        "the planted mutants name it, which are written while it is built",
    ),
    (
        "certify/host",
        "rigproof-impl-c",
        "its static library is linked by the examples in C",
    ),
    (
        "trace/fuzz",
        "tempfile",
        "the claims name it, which stand beside the targets",
    ),
    (
        "certify/fuzz",
        "httparse",
        "the head of a request names it, which is the program's",
    ),
];

#[test]
fn every_dependency_is_used() {
    let sources = sources();
    let packages = packages();
    let mut violations = Vec::new();
    for package in &packages {
        let manifest = manifest(&format!("{package}/Cargo.toml"));
        let own = of_package(&sources, package, &packages);
        assert!(!own.is_empty(), "{package}: no source is read");
        let unseen = |name: &str| {
            let known = UNSEEN.iter();
            known
                .filter(|(room, _, _)| room == package)
                .any(|(_, dependency, _)| *dependency == name)
        };
        for (heading, name) in unused(package, &manifest, &own) {
            if !unseen(&name) {
                violations.push(format!(
                    "{package}/Cargo.toml: [{heading}] `{name}`: no source that is built with it names it: delete it, or move it to where it is used"
                ));
            }
        }
    }
    assert_tidy("unused dependencies", violations);
}

/// The folders of all packages, members or not.
fn packages() -> Vec<String> {
    let apart = APART.iter().map(|&package| package.to_owned());
    members().into_iter().chain(apart).collect()
}

/// The sources of a package: those below its folder that are of no package within.
fn of_package<'a>(sources: &'a [Text], package: &str, packages: &[String]) -> Vec<&'a Text> {
    let below = |path: &str, folder: &str| {
        path.strip_prefix(folder)
            .is_some_and(|rest| rest.starts_with('/'))
    };
    let within: Vec<&String> = packages
        .iter()
        .filter(|other| below(other, package))
        .collect();
    sources
        .iter()
        .filter(|source| below(&source.path, package))
        .filter(|source| !within.iter().any(|other| below(&source.path, other)))
        .collect()
}

/// What is named in a manifest and in no source that is built with it: heading and name.
fn unused(package: &str, manifest: &Table, sources: &[&Text]) -> Vec<(&'static str, String)> {
    let named: Vec<(&str, BTreeSet<String>)> = sources
        .iter()
        .map(|source| {
            let below = source.path[package.len() + 1..].as_ref();
            (below, crates(&parse(&source.path, &source.content)))
        })
        .collect();
    let is_named = |name: &str, folder: &str| {
        let name = name.replace('-', "_");
        named
            .iter()
            .any(|(path, crates)| path.starts_with(folder) && crates.contains(&name))
    };
    // A package apart may name its one folder of programs otherwise.
    let has_src = named.iter().any(|(path, _)| path.starts_with("src/"));
    let program = if has_src { "src/" } else { "" };
    let mut found = Vec::new();
    for (heading, folder) in [
        ("dependencies", program),
        ("dev-dependencies", ""),
        ("build-dependencies", "build.rs"),
    ] {
        for (name, entry) in entries_under(manifest, heading) {
            // One that a feature asks for may be an example's, which has no heading of its own.
            let is_optional = entry.get("optional").and_then(Value::as_bool) == Some(true);
            if !is_named(&name, if is_optional { "" } else { folder }) {
                found.push((heading, name));
            }
        }
    }
    found
}

/// The crates that a source may name: what stands first in a path, and what `use` takes whole.
fn crates(tokens: &[TokenTree]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let punct = |token: Option<&TokenTree>| matches!(token, Some(TokenTree::Punct(mark)) if mark.as_char() == ':');
    for (at, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Ident(name) => {
                let inside_a_path =
                    at > 1 && punct(tokens.get(at - 1)) && punct(tokens.get(at - 2));
                let of_a_path = punct(tokens.get(at + 1)) && punct(tokens.get(at + 2));
                let taken_whole = at > 0
                    && matches!(&tokens[at - 1], TokenTree::Ident(word) if word == "use" || word == "crate");
                if (of_a_path && !inside_a_path) || taken_whole {
                    found.insert(name.to_string());
                }
            }
            TokenTree::Group(group) => found.extend(crates(&inner(group))),
            _ => {}
        }
    }
    found
}

#[test]
fn an_unused_dependency_is_noticed() {
    let text = |path: &str, content: &str| Text {
        path: path.to_owned(),
        content: content.to_owned(),
    };
    let sources = [
        text(
            "room/src/lib.rs",
            "use one::{Thing, other::two}; fn f() { g(&five_six::x::seven::y()) }",
        ),
        text(
            "room/tests/t.rs",
            "use three; use four as other; fn f() { ten::x() }",
        ),
        text("room/inner/src/lib.rs", "use two::x; #[test] fn t() {}"),
        text("room/build.rs", "fn main() { eight::x() }"),
    ];
    let packages = ["room".to_owned(), "room/inner".to_owned()];
    let own = of_package(&sources, "room", &packages);
    assert_eq!(own.len(), 3);
    let manifest: Table =
        "[dependencies]\none.workspace = true\ntwo.workspace = true\nthree.workspace = true\n\
        five-six.workspace = true\nseven.workspace = true\neight.workspace = true\n\
        ten = { workspace = true, optional = true }\neleven = { workspace = true, optional = true }\n\
        [dev-dependencies]\nthree.workspace = true\nfour.workspace = true\nnine.workspace = true\n\
        [build-dependencies]\neight.workspace = true\none.workspace = true\n"
            .parse()
            .unwrap();
    let found = unused("room", &manifest, &own);
    let names: Vec<&str> = found.iter().map(|(_, name)| name.as_str()).collect();
    assert_eq!(
        names,
        ["eight", "eleven", "seven", "three", "two", "nine", "one"]
    );
}
