//! This file holds the local page of runs: what it shows, whom it answers, and what it survives.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::desk::Desk;

/// A server that ends with the test.
pub struct Served {
    child: Child,
    pub address: SocketAddr,
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Served {
    pub fn begin(desk: &Desk, words: &[&str]) -> Served {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rigproof"));
        let command = command
            .arg("serve")
            .args(words)
            .args(["--port", "0", "--for-s", "600"]);
        let command = command.current_dir(desk.path(".")).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().unwrap())
            .read_line(&mut line)
            .unwrap();
        let address = line
            .trim()
            .strip_prefix("http://")
            .unwrap()
            .trim_end_matches('/');
        let address = address.parse().unwrap();
        Served { child, address }
    }

    /// The number of its process.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .unwrap();
        stream
    }

    /// What is answered to these bytes.
    fn raw(&self, request: &str) -> String {
        let mut stream = self.connect();
        stream.write_all(request.as_bytes()).unwrap();
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    pub fn get(&self, path: &str) -> String {
        self.raw(&format!(
            "GET {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n",
            self.address
        ))
    }
}

fn status(answer: &str) -> &str {
    answer.split(' ').nth(1).unwrap_or("none")
}

/// Two runs, and beside the folder something that nobody is to see.
fn desk() -> Desk {
    let desk = Desk::new();
    for (name, verdict, value) in [("one", "explained", 0.31), ("two <b>", "ambiguous", 0.42)] {
        fs::create_dir_all(desk.path(&format!("runs/{name}"))).unwrap();
        let effect = format!(
            "{{\"mechanism\":\"viscous\",\"joint\":\"E\",\"parameters\":{{\"coefficient\":{{\"value\":{value},\"unit\":\"N·m·s/rad\"}}}}}}"
        );
        desk.put(
            &format!("runs/{name}/report.json"),
            &format!(
                "{{\"verdict\":\"{verdict}\",\"summary\":\"<i>words</i>\",\"effects\":[{effect}]}}"
            ),
        );
        desk.put(
            &format!("runs/{name}/report.html"),
            &format!("<!DOCTYPE html><title>page of {name}</title>"),
        );
        desk.put(&format!("runs/{name}/notes.txt"), "secret notes");
    }
    desk.put("secret.txt", "secret outside");
    fs::create_dir_all(desk.path("outside")).unwrap();
    desk.put("outside/report.json", "{\"verdict\":\"secret\"}");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(desk.path("outside"), desk.path("runs/link")).unwrap();
        fs::create_dir_all(desk.path("runs/three")).unwrap();
        desk.put(
            "runs/three/report.json",
            "{\"verdict\":\"consistent\",\"summary\":\"<i>nothing</i>\"}",
        );
        std::os::unix::fs::symlink(desk.path("secret.txt"), desk.path("runs/three/report.html"))
            .unwrap();
    }
    desk
}

#[test]
fn runs_are_listed_shown_and_compared_and_nothing_else_is_there() {
    let desk = desk();
    let served = Served::begin(&desk, &["runs"]);
    let list = served.get("/");
    assert_eq!(status(&list), "200", "{list}");
    assert!(
        list.contains("explained")
            && list.contains("two &lt;b&gt;")
            && list.contains("&lt;i&gt;nothing")
            && list.contains("at joint E")
    );
    assert!(!list.contains("secret"), "a link is no run");
    assert!(served.get("/run/one/report.html").contains("page of one"));
    assert!(
        served
            .get("/run/two%20%3Cb%3E/report.html")
            .contains("page of two")
    );
    let compared = served.get("/compare?one=one&other=two+%3Cb%3E");
    assert!(
        compared.contains("viscous at E: coefficient")
            && compared.contains("0.3100")
            && compared.contains("0.4200"),
        "{compared}"
    );
    for path in [
        "/run/one/notes.txt",
        "/run/../secret.txt",
        "/run/one/../../secret.txt",
        "/run/%2e%2e/secret.txt",
        "/run/one/%2e%2e%2f%2e%2e%2fsecret.txt",
        "/run/one/..%5c..%5csecret.txt",
        "/run/..%2foutside/report.json",
        "/run/link/report.json",
        "/run/three/report.html",
        "/run//report.json",
        "/run/./report.json",
        "/run/one/report.json%00.html",
        "/run/%ff/report.json",
        "//secret.txt",
        "/../secret.txt",
        "/compare?one=one&other=..%2foutside",
    ] {
        let answer = served.get(path);
        assert_eq!(status(&answer), "404", "{path}: {answer}");
        assert!(!answer.contains("secret"), "{path}: {answer}");
    }
}

/// What `/state.json` says.
fn state(served: &Served) -> serde_json::Value {
    let answer = served.get("/state.json");
    assert_eq!(status(&answer), "200", "{answer}");
    serde_json::from_str(answer.split_once("\r\n\r\n").unwrap().1).unwrap()
}

#[test]
fn the_state_changes_with_the_runs_and_with_nothing_else() {
    let desk = desk();
    let served = Served::begin(&desk, &["runs"]);
    let first = state(&served);
    let revision = first["revision"].as_str().unwrap();
    assert!(
        served
            .get("/")
            .contains(&format!("data-revision=\"{revision}\""))
    );
    assert_eq!(first["is_busy"], false);
    assert!(first["now"].as_str().unwrap().contains("--rig"), "{first}");
    desk.put("runs/one/notes.txt", "more notes");
    desk.put("outside/report.json", "{\"verdict\":\"another\"}");
    assert_eq!(state(&served), first);
    fs::create_dir_all(desk.path("runs/four")).unwrap();
    assert_eq!(state(&served), first, "a folder without a result is no run");
    desk.put("runs/four/report.json", "{\"verdict\":\"consistent\"}");
    let second = state(&served);
    assert_ne!(second["revision"], first["revision"]);
    desk.put("runs/one/report.json", "{\"verdict\":\"data_fault\"}");
    assert_ne!(state(&served)["revision"], second["revision"]);
}

#[test]
fn strangers_are_not_answered_and_nothing_can_be_sent() {
    let desk = desk();
    let served = Served::begin(&desk, &["runs"]);
    let port = served.address.port();
    for host in [
        "evil.example".to_owned(),
        format!("evil.example:{port}"),
        "127.0.0.1".to_owned(),
        format!("127.0.0.1.evil.example:{port}"),
    ] {
        for page in ["/", "/state.json"] {
            let answer = served.raw(&format!(
                "GET {page} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"
            ));
            assert_eq!(status(&answer), "403", "{host}{page}");
        }
    }
    let nobody = served.raw("GET / HTTP/1.0\r\n\r\n");
    assert_eq!(status(&nobody), "403", "{nobody}");
    for method in ["POST", "PUT", "DELETE", "OPTIONS"] {
        let answer = served.raw(&format!(
            "{method} / HTTP/1.1\r\nHost: {}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n",
            served.address
        ));
        assert_eq!(status(&answer), "405", "{method}");
    }
    assert!(served.address.ip().is_loopback());
    // Another address of the same machine: a listener on every address would answer there.
    #[cfg(target_os = "linux")]
    assert!(TcpStream::connect(("127.0.0.2", port)).is_err());
}

#[test]
fn many_reloads_and_cut_connections_leave_it_healthy() {
    let desk = desk();
    let served = Served::begin(&desk, &["runs"]);
    // Half a request and silence, kept open all the time.
    let silent: Vec<TcpStream> = (0..40)
        .map(|_| {
            let mut stream = served.connect();
            stream.write_all(b"GET / HT").unwrap();
            stream
        })
        .collect();
    for k in 0..200 {
        let mut gone = served.connect();
        let request = format!("GET / HTTP/1.1\r\nHost: {}\r\n\r\n", served.address);
        // A browser that is killed while it asks, or while it reads.
        let length = if k % 2 == 0 {
            request.len() / 2
        } else {
            request.len()
        };
        gone.write_all(&request.as_bytes()[..length]).unwrap();
        if k % 4 == 1 {
            let _ = gone.read(&mut [0; 16]);
        }
        drop(gone);
    }
    for _ in 0..100 {
        assert_eq!(status(&served.get("/run/one/report.html")), "200");
    }
    assert_eq!(status(&served.raw("\u{1}\u{2} no request\r\n\r\n")), "400");
    assert_eq!(
        status(&served.get(&format!("/run/{}", "a".repeat(60_000)))),
        "404"
    );
    assert_eq!(status(&served.get("/")), "200");
    drop(silent);
}

#[test]
fn a_recording_that_comes_is_diagnosed_and_one_that_is_wrong_is_told() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 11 --stratum single --out case",
        0,
    );
    fs::create_dir_all(desk.path("runs")).unwrap();
    let served = Served::begin(&desk, &["runs", "--rig", "case/rig.toml"]);
    fs::write(desk.path("runs/wrong.csv"), "a,b\n1,2\n").unwrap();
    fs::copy(desk.path("case/recording.csv"), desk.path("runs/first.csv")).unwrap();
    let begun = Instant::now();
    let until = |what: &str, holds: &dyn Fn() -> bool| {
        while !holds() {
            assert!(begun.elapsed() < Duration::from_secs(100), "{what}");
            std::thread::sleep(Duration::from_millis(200));
        }
    };
    let page = desk.path("runs/first-diagnosis/report.html");
    until("the diagnosis", &|| Path::new(&page).is_file());
    until("the list", &|| {
        served
            .get("/")
            .contains("/run/first%2Ddiagnosis/report.html")
    });
    until("what is wrong", &|| served.get("/").contains("wrong.csv"));
    assert!(fs::read_to_string(page).unwrap().contains("Diagnosis"));
}
