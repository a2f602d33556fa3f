//! This file answers a request: it takes nothing from its address but names, and looks them up in a list.

use std::fs::File;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use percent_encoding::percent_decode_str;
use serde_json::{Value, json};

use super::connect::Body;
use super::head::Asked;
use super::listing::{SHOWN, path_of, regular, revision, runs};
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
    /// Held while results are read: many who ask at once do not fill the memory.
    pub reading: Mutex<()>,
}

impl Site {
    fn one_at_a_time(&self) -> MutexGuard<'_, ()> {
        self.reading.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Status, type, body, and whether it is a file that somebody else may have written.
struct Answer {
    status: u16,
    kind: &'static str,
    body: Body,
    is_stored: bool,
}

/// What a stored page may do: run its own scripts in an origin of its own, which nothing else shares, and ask nobody. A page of ours has a narrower policy in itself.
const STORED: &str = "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; connect-src 'none'; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// What any other stored file may do that is opened by itself.
const FILE: &str = "sandbox; default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'";

/// Head and body of the answer to a request, or to what is none.
pub fn answer(site: &Site, asked: Result<Asked, (u16, &'static str)>) -> (String, Body) {
    let is_head = asked.as_ref().is_ok_and(|asked| asked.method == "HEAD");
    let Answer {
        status,
        kind,
        body,
        is_stored,
    } = match asked {
        Err((status, why)) => words(status, why),
        Ok(asked) => answered(site, &asked),
    };
    let policy = match (kind.starts_with("text/html"), is_stored) {
        (true, true) => STORED,
        (true, false) => "frame-ancestors 'none'",
        (false, _) => FILE,
    };
    let (reason, length) = (reason(status), body.len());
    let head = format!(
        "HTTP/1.1 {status} {reason}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nConnection: close\r\nCache-Control: no-store\r\n\
         X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n\
         Cross-Origin-Opener-Policy: same-origin\r\nX-Frame-Options: DENY\r\nContent-Security-Policy: {policy}\r\n\r\n"
    );
    match is_head {
        true => (head, Body::Bytes(Vec::new())),
        false => (head, body),
    }
}

fn answered(site: &Site, asked: &Asked) -> Answer {
    let is_read = ["GET", "HEAD"].contains(&asked.method.as_str());
    match (
        names_this_machine(asked.host.as_deref(), site.port),
        is_read,
    ) {
        // Another name that leads here is a page of a stranger that asks through the browser.
        (false, _) => words(403, "This page answers to 127.0.0.1 and localhost only."),
        (_, false) => words(405, "There is nothing to change here."),
        _ => shown(site, &asked.url),
    }
}

const fn reason(status: u16) -> &'static str {
    match status {
        200 => "OK",
        400 => "Bad Request",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        408 => "Request Timeout",
        _ => "Request Header Fields Too Large",
    }
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

fn made(status: u16, kind: &'static str, bytes: Vec<u8>) -> Answer {
    Answer {
        status,
        kind,
        body: Body::Bytes(bytes),
        is_stored: false,
    }
}

fn words(status: u16, words: &str) -> Answer {
    made(
        status,
        "text/plain; charset=utf-8",
        words.as_bytes().to_vec(),
    )
}

fn html(page: String) -> Answer {
    made(200, "text/html; charset=utf-8", page.into_bytes())
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
            let _one_at_a_time = site.one_at_a_time();
            let revision = state(site).1;
            html(pages::list(&runs(&site.folder), site, &revision))
        }
        ["state.json"] => made(
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
    let _one_at_a_time = site.one_at_a_time();
    let runs = runs(&site.folder);
    let find = |key: &str| value(key).and_then(|name| runs.iter().find(|run| run.name == name));
    match (find("one"), find("other")) {
        (Some(one), Some(other)) => html(pages::compared(one, other)),
        _ => words(404, "Choose two runs of the list."),
    }
}

/// A file of a run. Neither name makes a path: they are looked up among the folders that are there and the files that are shown.
fn file_of(site: &Site, name: &str, file: &str) -> Answer {
    let run = path_of(&site.folder, name);
    let shown = SHOWN.into_iter().find(|(own, _)| *own == file);
    let (Some(run), Some((file, kind))) = (run, shown) else {
        return words(404, "There is no such file.");
    };
    let path = run.join(file);
    let opened = regular(&path).and_then(|_| File::open(&path).ok());
    // What was opened is asked, not its name: that may be another's by now.
    let opened = opened.and_then(|opened| Some((opened.metadata().ok()?, opened)));
    match opened {
        Some((metadata, opened)) if metadata.is_file() => Answer {
            status: 200,
            kind,
            body: Body::File(opened, metadata.len()),
            is_stored: true,
        },
        _ => words(404, "There is no such file."),
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
