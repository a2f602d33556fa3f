//! This file says how a Rust source may look: its first line, its length, its functions and its tests.

use std::collections::BTreeSet;

use proc_macro2::{Delimiter, Group, Ident, TokenStream, TokenTree};

use crate::tidy::assert_tidy;
use crate::tidy::workspace::{Text, sources};

const LONGEST_FILE: usize = 500;
const LONGEST_FUNCTION: usize = 70;

#[test]
fn every_source_opens_with_what_it_says() {
    assert_tidy("first lines", unopened(&sources()));
}

fn unopened(sources: &[Text]) -> Vec<String> {
    let silent = sources
        .iter()
        .filter(|source| !source.content.starts_with("//! "));
    silent
        .map(|source| format!("{}:1: open with one `//!` sentence", source.path))
        .collect()
}

#[test]
fn no_source_is_longer_than_500_lines() {
    assert_tidy("long files", long_files(&sources()));
}

/// Of what the program itself writes, nobody divides a file.
fn is_made(source: &Text) -> bool {
    let first = source.content.lines().next();
    first.is_some_and(|line| line.contains("Made by `rigproof "))
}

fn long_files(sources: &[Text]) -> Vec<String> {
    sources
        .iter()
        .filter(|source| !is_made(source))
        .map(|source| (source, source.content.lines().count()))
        .filter(|(_, lines)| *lines > LONGEST_FILE)
        .map(|(source, lines)| format!("{}:{lines}: divide the file by purpose", source.path))
        .collect()
}

#[test]
fn no_function_is_longer_than_70_lines() {
    let violations = check_sources(&|tokens, report| {
        for (name, lines) in long_functions(tokens) {
            let advice = format!("`{name}` has {lines} lines: name its parts");
            report(&name, advice);
        }
    });
    assert_tidy("long functions", violations);
}

fn long_functions(tokens: &[TokenTree]) -> Vec<(Ident, usize)> {
    let functions = functions(tokens).into_iter();
    let lengths = functions.map(|function| {
        let first = function.name.span().start().line;
        let lines = function.body.span_close().end().line + 1 - first;
        (function.name, lines)
    });
    lengths
        .filter(|(_, lines)| *lines > LONGEST_FUNCTION)
        .collect()
}

#[test]
fn every_property_is_marked_as_a_test() {
    let violations = check_sources(&|tokens, report| {
        for name in properties_that_never_run(tokens) {
            let advice = format!("`{name}` never runs: put #[test] above it");
            report(&name, advice);
        }
    });
    assert_tidy("properties that never run", violations);
}

/// Properties, of values or of sequences of operations, that are no tests.
fn properties_that_never_run(tokens: &[TokenTree]) -> Vec<Ident> {
    let mut found = Vec::new();
    for (name, body) in macros(tokens) {
        if name == "proptest" {
            let all = functions(&inner(&body)).into_iter();
            found.extend(
                all.filter(|function| function.nested == 0 && !function.has_attribute("test"))
                    .map(|function| function.name),
            );
        }
        // A machine's property ends in a semicolon: its attributes stand right before it.
        if name == "prop_state_machine" {
            let tokens = inner(&body);
            let marked = attributes(&tokens)
                .iter()
                .filter(|name| *name == "test")
                .count();
            let names = tokens.windows(2).filter_map(|pair| match pair {
                [TokenTree::Ident(word), TokenTree::Ident(name)] if word == "fn" => {
                    Some(name.clone())
                }
                _ => None,
            });
            found.extend(names.skip(marked));
        }
    }
    found
}

/// The names of every claim of the rig's own code.
pub fn claim_names() -> Vec<String> {
    let mut names = Vec::new();
    for source in sources() {
        if source.path.starts_with("impl/") {
            names.extend(names_of_claims(&tokens(&source)));
        }
    }
    names
}

fn names_of_claims(tokens: &[TokenTree]) -> Vec<String> {
    let mut names = Vec::new();
    for (name, body) in macros(tokens) {
        if name == "claims" {
            let claims = functions(&inner(&body));
            names.extend(claims.iter().map(|claim| claim.name.to_string()));
        }
    }
    names
}

#[test]
fn a_property_without_its_mark_and_a_long_file_are_noticed() {
    let properties = |content| {
        let never = properties_that_never_run(&parse("example", content));
        never.iter().map(Ident::to_string).collect::<Vec<_>>()
    };
    assert_eq!(
        properties("proptest! { #[test] fn p(x in 0..3) {} }").len(),
        0
    );
    assert_eq!(
        properties("proptest! { #[test] fn p(x in 0..3) {} fn q() {} }"),
        ["q"]
    );
    assert_eq!(
        properties("prop_state_machine! { fn p(sequential 1..3 => T); }"),
        ["p"]
    );
    assert_eq!(
        properties("prop_state_machine! { #[test] fn p(sequential 1..3 => T); }").len(),
        0
    );
    let file = |lines| Text {
        path: "example.rs".to_owned(),
        content: "//! This.\n".repeat(lines),
    };
    assert_eq!(long_files(&[file(LONGEST_FILE)]).len(), 0);
    assert_eq!(long_files(&[file(LONGEST_FILE + 1)]).len(), 1);
}

#[test]
fn no_test_is_ignored_and_no_code_unfinished() {
    let violations = check_sources(&|tokens, report| {
        for (name, advice) in unfinished(tokens) {
            report(&name, advice);
        }
    });
    assert_tidy("unfinished code", violations);
}

fn unfinished(tokens: &[TokenTree]) -> Vec<(Ident, String)> {
    let words = [concat!("to", "do"), concat!("unimple", "mented")];
    let mut found = Vec::new();
    for (name, _) in macros(tokens) {
        if words.iter().any(|word| name == *word) {
            let advice = format!("`{name}!` is no result: write the code");
            found.push((name, advice));
        }
    }
    let ignored = attributes(tokens)
        .into_iter()
        .filter(|attribute| attribute == "ignore");
    found.extend(ignored.map(|attribute| (attribute, "run the test or delete it".to_owned())));
    found
}

#[test]
fn every_kani_harness_is_made_of_a_claim() {
    let violations = check_sources(&|tokens, report| {
        for attribute in harnesses_by_hand(tokens) {
            let advice =
                "write the claim in `claims!`, which makes its harness and its line in the ledger";
            report(&attribute, advice.to_owned());
        }
    });
    assert_tidy("harnesses without a claim", violations);
}

/// Attributes of Kani above a function; the macro of the claims has them inside another.
fn harnesses_by_hand(tokens: &[TokenTree]) -> Vec<Ident> {
    let mut attributes = attributes(tokens);
    attributes.retain(|attribute| attribute == "kani");
    attributes
}

#[test]
fn a_source_that_breaks_a_rule_is_noticed() {
    let source = |content: &str| Text {
        path: "example.rs".to_owned(),
        content: content.to_owned(),
    };
    assert_eq!(
        unopened(&[source("// This.\n"), source("//! This.\n")]).len(),
        1
    );
    let long = |lines: usize| {
        let body = "    f();\n".repeat(lines - 2);
        long_functions(&parse("example", &format!("fn f() {{\n{body}}}\n"))).len()
    };
    assert_eq!((long(LONGEST_FUNCTION), long(LONGEST_FUNCTION + 1)), (0, 1));
    let word = concat!("to", "do");
    let tokens = parse(
        "example",
        &format!("fn f() {{ {word}!() }} #[ignore] fn g() {{}}"),
    );
    assert_eq!(unfinished(&tokens).len(), 2);
    let harness = "#[kani::proof] fn p() {} #[cfg_attr(not(kani_shim), kani::proof)] fn q() {}";
    assert_eq!(harnesses_by_hand(&parse("example", harness)).len(), 1);
    let claims = "claims! { /// It holds.\n Finite fn one(c) {} Numbers fn two(c) {} }";
    assert_eq!(names_of_claims(&parse("example", claims)), ["one", "two"]);
}

#[test]
fn rules_see_what_breaks_them() {
    let tokens = parse(
        "example",
        "proptest! { fn p(x in 0..3) { todo!(); } #[test] fn q() {} } #[ignore] fn r() {}",
    );
    let names: Vec<String> = functions(&tokens)
        .iter()
        .map(|f| f.name.to_string())
        .collect();
    assert_eq!(names, ["p", "q", "r"]);
    assert!(!functions(&tokens)[0].has_attribute("test"));
    assert!(functions(&tokens)[1].has_attribute("test"));
    assert!(functions(&tokens)[2].has_attribute("ignore"));
    assert_eq!(macros(&tokens).len(), 2);
    assert_eq!(attributes(&tokens).len(), 2);
}

/// The names of every test function of the workspace.
pub fn test_names() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for source in sources() {
        for function in functions(&tokens(&source)) {
            if function.has_attribute("test") {
                names.insert(function.name.to_string());
            }
        }
    }
    names
}

type Report<'a> = &'a mut dyn FnMut(&Ident, String);

fn check_sources(rule: &dyn Fn(&[TokenTree], Report)) -> Vec<String> {
    let mut violations = Vec::new();
    for source in sources() {
        rule(&tokens(&source), &mut |place: &Ident, advice: String| {
            let line = place.span().start().line;
            violations.push(format!("{}:{line}: {advice}", source.path));
        });
    }
    violations
}

fn tokens(source: &Text) -> Vec<TokenTree> {
    parse(&source.path, &source.content)
}

pub fn parse(path: &str, content: &str) -> Vec<TokenTree> {
    match content.parse::<TokenStream>() {
        Ok(stream) => stream.into_iter().collect(),
        Err(error) => panic!("{path}:{}: {error}", error.span().start().line),
    }
}

struct Function {
    name: Ident,
    body: Group,
    attributes: Vec<Ident>,
    /// How many functions it stands in.
    nested: usize,
}

impl Function {
    fn has_attribute(&self, name: &str) -> bool {
        self.attributes.iter().any(|attribute| attribute == name)
    }
}

/// Every function with a body, in order, those inside others and inside macros included.
fn functions(tokens: &[TokenTree]) -> Vec<Function> {
    let mut found = Vec::new();
    collect_functions(tokens, 0, &mut found);
    found
}

fn collect_functions(tokens: &[TokenTree], nested: usize, found: &mut Vec<Function>) {
    let mut attributes = Vec::new();
    let mut rest = tokens;
    while let Some((token, after)) = rest.split_first() {
        rest = after;
        match token {
            TokenTree::Ident(word) if word == "fn" => {
                let (Some(TokenTree::Ident(name)), Some((body, after))) =
                    (after.first(), body(after))
                else {
                    continue;
                };
                found.push(Function {
                    name: name.clone(),
                    body: body.clone(),
                    attributes: std::mem::take(&mut attributes),
                    nested,
                });
                collect_functions(&inner(body), nested + 1, found);
                rest = after;
            }
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                if let Some((TokenTree::Group(attribute), after)) = after.split_first() {
                    attributes.extend(first_word(attribute));
                    rest = after;
                }
            }
            TokenTree::Punct(mark) if [';', ','].contains(&mark.as_char()) => attributes.clear(),
            TokenTree::Group(group) => {
                collect_functions(&inner(group), nested, found);
                if group.delimiter() == Delimiter::Brace {
                    attributes.clear();
                }
            }
            _ => {}
        }
    }
}

/// The braces of a function whose name and parameters come first, and what follows them.
fn body(tokens: &[TokenTree]) -> Option<(&Group, &[TokenTree])> {
    let mut rest = tokens;
    while let Some((token, after)) = rest.split_first() {
        match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                return Some((group, after));
            }
            TokenTree::Punct(mark) if mark.as_char() == ';' => return None,
            _ => rest = after,
        }
    }
    None
}

/// Every macro call: its name and its argument.
fn macros(tokens: &[TokenTree]) -> Vec<(Ident, Group)> {
    let mut found = Vec::new();
    for window in tokens.windows(3) {
        if let [
            TokenTree::Ident(name),
            TokenTree::Punct(mark),
            TokenTree::Group(argument),
        ] = window
            && mark.as_char() == '!'
        {
            found.push((name.clone(), argument.clone()));
        }
    }
    for group in groups(tokens) {
        found.extend(macros(&inner(group)));
    }
    found
}

/// The name of every attribute.
fn attributes(tokens: &[TokenTree]) -> Vec<Ident> {
    let mut found = Vec::new();
    for window in tokens.windows(2) {
        if let [TokenTree::Punct(mark), TokenTree::Group(attribute)] = window
            && mark.as_char() == '#'
        {
            found.extend(first_word(attribute));
        }
    }
    for group in groups(tokens) {
        found.extend(attributes(&inner(group)));
    }
    found
}

fn groups(tokens: &[TokenTree]) -> impl Iterator<Item = &Group> {
    tokens.iter().filter_map(|token| match token {
        TokenTree::Group(group) => Some(group),
        _ => None,
    })
}

fn first_word(group: &Group) -> Option<Ident> {
    match group.stream().into_iter().next() {
        Some(TokenTree::Ident(word)) => Some(word),
        _ => None,
    }
}

pub fn inner(group: &Group) -> Vec<TokenTree> {
    group.stream().into_iter().collect()
}
