//! This file answers a request: it takes nothing from its address but names, and looks them up in a list.

use std::io::Cursor;
use std::path::PathBuf;
use std::sync::Arc;

use percent_encoding::percent_decode_str;
use serde_json::{Value, json};
use tiny_http::{Header, Method, Request, Response};

use super::listing::{Run, SHOWN, regular, revision, runs};
use super::pages;
use super::watch::Watch;

/// What is served.
pub struct Site {
    /// The folder with the runs.
    pub folder: PathBuf,
    /// The port that is listened on.
    pub port: u16,
    /// Whether recordings that come are diagnosed.
    pub is_watching: bool,
    /// What is being diagnosed.
    pub watch: Arc<Watch>,
}

/// Status, type and body.
type Answer = (u16, &'static str, Vec<u8>);

/// Answers; a browser that is gone by now is no fault.
pub fn answer(site: &Site, request: Request) {
    let host = request
        .headers()
        .iter()
        .find(|header| header.field.equiv("Host"));
    let host = host.map(|header| header.value.as_str().to_owned());
    let is_read = matches!(request.method(), Method::Get | Method::Head);
    let (status, kind, body) = match (names_this_machine(host.as_deref(), site.port), is_read) {
        // Another name that leads here is a page of a stranger that asks through the browser.
        (false, _) => words(403, "This page answers to 127.0.0.1 and localhost only."),
        (_, false) => words(405, "There is nothing to change here."),
        _ => shown(site, request.url()),
    };
    let mut response = Response::new(
        status.into(),
        Vec::new(),
        Cursor::new(body.clone()),
        Some(body.len()),
        None,
    );
    let headers = [
        ("Content-Type", kind),
        ("Cache-Control", "no-store"),
        ("X-Content-Type-Options", "nosniff"),
        ("Referrer-Policy", "no-referrer"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("X-Frame-Options", "DENY"),
        // An SVG that is opened by itself runs no script either; pages state a narrower policy of their own.
        (
            "Content-Security-Policy",
            if kind.starts_with("text/html") {
                "frame-ancestors 'none'"
            } else {
                "default-src 'none'; style-src 'unsafe-inline'"
            },
        ),
    ];
    for (name, value) in headers {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    let _ = request.respond(response);
}

/// Whether a request was sent to this machine by its own name.
fn names_this_machine(host: Option<&str>, port: u16) -> bool {
    let names = ["127.0.0.1", "localhost", "[::1]"];
    host.is_some_and(|host| {
        names
            .iter()
            .any(|name| host == format!("{name}:{port}") || (port == 80 && host == *name))
    })
}

fn words(status: u16, words: &str) -> Answer {
    (
        status,
        "text/plain; charset=utf-8",
        words.as_bytes().to_vec(),
    )
}

fn html(page: String) -> Answer {
    (200, "text/html; charset=utf-8", page.into_bytes())
}

fn shown(site: &Site, url: &str) -> Answer {
    let (path, query) = url.split_once('?').unwrap_or((url, ""));
    let decoded = |part: &str| {
        percent_decode_str(part)
            .decode_utf8()
            .ok()
            .map(|part| part.into_owned())
    };
    let parts: Option<Vec<String>> = path
        .trim_start_matches('/')
        .split('/')
        .map(decoded)
        .collect();
    let parts = parts.unwrap_or_default();
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    match parts.as_slice() {
        // What the list was made from is asked first: what changes meanwhile is then seen once more, and not missed.
        [""] => {
            let revision = state(site).1;
            html(pages::list(&runs(&site.folder), site, &revision))
        }
        ["state.json"] => (
            200,
            "application/json",
            state(site).0.to_string().into_bytes(),
        ),
        ["compare"] => compare(site, query),
        ["run", name, file] => file_of(site, name, file),
        _ => words(404, "There is no such page."),
    }
}

/// What is under way, and what a list would be made from now.
fn state(site: &Site) -> (Value, String) {
    let state = site.watch.state();
    let revision = revision(&site.folder, &state.failed);
    let is_busy = state.now.is_some() || state.waiting > 0;
    let now = pages::now(&state, site.is_watching);
    let value = json!({ "revision": revision, "now": now, "is_busy": is_busy });
    (value, revision)
}

fn compare(site: &Site, query: &str) -> Answer {
    let value = |key: &str| {
        let mut pairs = query.split('&').filter_map(|pair| pair.split_once('='));
        let found = pairs.find(|(own, _)| *own == key);
        found.and_then(|(_, value)| {
            percent_decode_str(&value.replace('+', " "))
                .decode_utf8()
                .ok()
                .map(|value| value.into_owned())
        })
    };
    let runs = runs(&site.folder);
    let find = |key: &str| value(key).and_then(|name| runs.iter().find(|run| run.name == name));
    match (find("one"), find("other")) {
        (Some(one), Some(other)) => html(pages::compared(one, other)),
        _ => words(404, "Choose two runs of the list."),
    }
}

/// A file of a run. Neither name makes a path: they are looked up among the runs that are there and the files that are shown.
fn file_of(site: &Site, name: &str, file: &str) -> Answer {
    let run: Option<Run> = runs(&site.folder).into_iter().find(|run| run.name == name);
    let shown = SHOWN.into_iter().find(|(own, _)| *own == file);
    let (Some(run), Some((file, kind))) = (run, shown) else {
        return words(404, "There is no such file.");
    };
    let path = run.path.join(file);
    match regular(&path).and_then(|_| std::fs::read(&path).ok()) {
        Some(bytes) => (200, kind, bytes),
        None => words(404, "There is no such file."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_this_machine_s_names_are_answered() {
        for host in ["127.0.0.1:7077", "localhost:7077", "[::1]:7077"] {
            assert!(names_this_machine(Some(host), 7077), "{host}");
        }
        for host in [
            "evil.example:7077",
            "127.0.0.1",
            "127.0.0.1:7078",
            "127.0.0.1.evil.example:7077",
            "192.168.1.5:7077",
            "",
        ] {
            assert!(!names_this_machine(Some(host), 7077), "{host}");
        }
        assert!(!names_this_machine(None, 7077));
    }
}
