//! This file is a crowd at the local page, slow, silent and oversized, on this machine's loopback alone; and folders that pretend to be runs.

use std::fs;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant, SystemTime};

use crate::desk::Desk;
use crate::serve::Served;

/// Clients of a crowd, together.
const CLIENTS: usize = 200;
/// In which time a client that behaves is answered, and the memory that the page may take, MB.
const ANSWERED: Duration = Duration::from_secs(1);
const MOST_MB: f64 = 200.0;
/// How long a diagnosis is waited for; a machine under load takes minutes.
const PATIENCE: Duration = Duration::from_secs(300);

/// A folder with some runs, one of which has a large file.
fn desk() -> Desk {
    let desk = Desk::new();
    for k in 0..20 {
        fs::create_dir_all(desk.path(&format!("runs/run{k}"))).unwrap();
        desk.put(
            &format!("runs/run{k}/report.json"),
            "{\"verdict\":\"explained\",\"summary\":\"words\"}",
        );
        desk.put(
            &format!("runs/run{k}/report.html"),
            "<!DOCTYPE html><title>page</title>",
        );
    }
    fs::write(desk.path("runs/run0/recording.csv"), vec![b'7'; 8 << 20]).unwrap();
    desk
}

fn connect(served: &Served) -> TcpStream {
    TcpStream::connect(served.address).unwrap()
}

/// The most memory that the page took, MB, where the system says.
fn peak_mb(served: &Served) -> Option<f64> {
    let status = fs::read_to_string(format!("/proc/{}/status", served.id())).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}

/// A client of a kind, connected and left as it is.
fn client(served: &Served, kind: usize) -> TcpStream {
    let mut stream = connect(served);
    let address = served.address;
    let request = match kind % 8 {
        // Silent, half a request, a body that never comes, a body that nobody could hold.
        0 => String::new(),
        1 => "GET / HT".to_owned(),
        2 => format!("POST / HTTP/1.1\r\nHost: {address}\r\nContent-Length: 50\r\n\r\n"),
        3 => format!("POST / HTTP/1.1\r\nHost: {address}\r\nContent-Length: 1000000000000\r\n\r\n"),
        // It asks for much and reads nothing.
        4 => format!("GET /run/run0/recording.csv HTTP/1.1\r\nHost: {address}\r\n\r\n"),
        5 => format!("GET / HTTP/1.1\r\nHost: {address}\r\n\r\n"),
        // A head without end, and a line of it.
        6 => format!(
            "GET / HTTP/1.1\r\nHost: {address}\r\nX: {}",
            "y".repeat(60_000)
        ),
        _ => format!(
            "GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\nHost: {address}\r\n\r\nfffffff\r\n"
        ),
    };
    let _ = stream.write_all(request.as_bytes());
    stream
}

#[test]
fn a_crowd_of_slow_silent_and_oversized_clients_keeps_nobody_waiting() {
    let desk = desk();
    let served = Served::begin(&desk, &["runs"]);
    let crowd: Vec<TcpStream> = (0..CLIENTS).map(|k| client(&served, k)).collect();
    let begun = Instant::now();
    let mut slowest = Duration::ZERO;
    let mut asked = 0;
    // For longer than a head is waited for.
    while begun.elapsed() < Duration::from_secs(7) {
        for path in ["/", "/state.json", "/run/run3/report.html"] {
            let at = Instant::now();
            let answer = served.get(path);
            slowest = slowest.max(at.elapsed());
            assert!(answer.starts_with("HTTP/1.1 200"), "{path}: {answer}");
            asked += 1;
        }
        // Some drip on.
        for (k, mut stream) in crowd.iter().enumerate() {
            if k % 8 == 1 || k % 8 == 6 {
                let _ = stream.write_all(b"a");
            }
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    let peak_mb = peak_mb(&served);
    println!(
        "{CLIENTS} clients: {asked} requests were answered, the slowest in {slowest:?}; at most {peak_mb:?} MB"
    );
    assert!(slowest < ANSWERED, "{slowest:?}");
    assert!(peak_mb.unwrap_or(0.0) < MOST_MB, "{peak_mb:?}");
    drop(crowd);
}

#[test]
fn more_connections_than_there_may_be_end_the_oldest() {
    let desk = desk();
    let served = Served::begin(&desk, &["runs"]);
    let crowd: Vec<TcpStream> = (0..300).map(|_| client(&served, 0)).collect();
    // How soon is held with a crowd that stays within the bound.
    assert!(served.get("/").starts_with("HTTP/1.1 200"));
    let mut first = crowd.first().unwrap();
    first
        .set_read_timeout(Some(Duration::from_secs(2)))
        .unwrap();
    assert_eq!(
        first.read(&mut [0; 8]).unwrap_or(1),
        0,
        "the oldest is still open"
    );
}

#[test]
fn a_head_that_is_too_long_or_never_ends_is_answered_and_ended() {
    let desk = desk();
    let served = Served::begin(&desk, &["runs"]);
    let mut long = connect(&served);
    let head = format!("GET / HTTP/1.1\r\nHost: {}\r\nX: ", served.address);
    long.write_all(head.as_bytes()).unwrap();
    let mut sent = 0;
    // It is ended long before 300 MB.
    while sent < 300 && long.write_all(&vec![b'y'; 1 << 20]).is_ok() {
        sent += 1;
    }
    assert!(sent < 100, "{sent} MB were taken");
    let at = Instant::now();
    let mut slow = connect(&served);
    slow.write_all(b"GET / HTTP/1.1\r\n").unwrap();
    slow.set_read_timeout(Some(Duration::from_secs(20)))
        .unwrap();
    let mut answer = String::new();
    let _ = slow.read_to_string(&mut answer);
    assert!(answer.starts_with("HTTP/1.1 408"), "{answer}");
    assert!(at.elapsed() < Duration::from_secs(8), "{:?}", at.elapsed());
    assert!(peak_mb(&served).unwrap_or(0.0) < MOST_MB);
}

#[test]
fn a_page_of_others_has_an_origin_of_its_own_and_no_connections() {
    let desk = desk();
    let served = Served::begin(&desk, &["runs"]);
    let policy = |path: &str| {
        let answer = served.get(path);
        let lines = answer.lines();
        let line = lines
            .into_iter()
            .find_map(|line| line.strip_prefix("Content-Security-Policy: "));
        line.unwrap_or_default().to_owned()
    };
    let page = policy("/run/run1/report.html");
    for part in [
        "sandbox allow-scripts",
        "default-src 'none'",
        "connect-src 'none'",
        "form-action 'none'",
        "base-uri 'none'",
    ] {
        assert!(page.contains(part), "{page}");
    }
    // With this word the sandbox would be none.
    assert!(
        !page.contains("allow-same-origin") && !page.contains("allow-popups"),
        "{page}"
    );
    // A drawing and a text are files of others too.
    desk.put(
        "runs/run1/residual.svg",
        "<svg xmlns=\"http://www.w3.org/2000/svg\"/>",
    );
    for path in ["/run/run1/residual.svg", "/run/run1/report.json"] {
        assert!(
            policy(path).starts_with("sandbox; default-src 'none'"),
            "{path}"
        );
    }
    assert!(!policy("/").contains("sandbox"));
}

#[test]
fn a_verdict_is_computed_and_what_is_left_of_a_write_is_no_run() {
    let desk = desk();
    fs::create_dir_all(desk.path("runs/forged")).unwrap();
    desk.put(
        "runs/forged/certificate.json",
        "{\"may_go_on_the_rig\":true,\"name\":\"forged\"}",
    );
    fs::create_dir_all(desk.path("runs/.rigproof-7-aB3.part")).unwrap();
    desk.put(
        "runs/.rigproof-7-aB3.part/report.json",
        "{\"verdict\":\"explained\",\"summary\":\"a leftover\"}",
    );
    let served = Served::begin(&desk, &["runs"]);
    let list = served.get("/");
    assert!(
        list.contains("forged") && list.contains("no verdict: it was changed"),
        "{list}"
    );
    assert!(!list.contains(">may go on the rig<"), "{list}");
    assert!(!list.contains("leftover"), "{list}");
    assert!(
        served
            .get("/run/.rigproof-7-aB3.part/report.json")
            .starts_with("HTTP/1.1 404")
    );
}

/// A recording that is replaced by another one with an older time stamp is diagnosed again.
#[test]
fn a_recording_is_known_by_its_bytes_and_not_by_its_time() {
    let desk = Desk::new();
    for seed in [11, 12] {
        desk.prints(
            &format!("blind make --plant bench --seed {seed} --stratum single --out case{seed}"),
            0,
        );
    }
    fs::create_dir_all(desk.path("runs")).unwrap();
    fs::copy(desk.path("case11/recording.csv"), desk.path("runs/a.csv")).unwrap();
    let served = Served::begin(&desk, &["runs", "--rig", "case11/rig.toml"]);
    let report = desk.path("runs/a-diagnosis/report.json");
    let of = |case: &str| rigproof_certify::digest::of_bytes(&fs::read(desk.path(case)).unwrap());
    let until_of = |sha256: &str| {
        let begun = Instant::now();
        while !fs::read_to_string(&report).is_ok_and(|text| text.contains(sha256)) {
            assert!(begun.elapsed() < PATIENCE, "{}", served.get("/"));
            std::thread::sleep(Duration::from_millis(200));
        }
    };
    until_of(&of("case11/recording.csv"));
    fs::copy(desk.path("case12/recording.csv"), desk.path("runs/a.csv")).unwrap();
    let file = fs::File::options()
        .write(true)
        .open(desk.path("runs/a.csv"))
        .unwrap();
    file.set_modified(SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000))
        .unwrap();
    drop(file);
    until_of(&of("case12/recording.csv"));
    // The same bytes under another time are not diagnosed again.
    let written = fs::metadata(&report).unwrap().modified().unwrap();
    let file = fs::File::options()
        .write(true)
        .open(desk.path("runs/a.csv"))
        .unwrap();
    file.set_modified(SystemTime::now() + Duration::from_secs(1000))
        .unwrap();
    drop(file);
    // One recording is diagnosed after another, in the order of their names: when a later one is done, this one would have been.
    std::thread::sleep(Duration::from_secs(2));
    fs::copy(desk.path("case11/recording.csv"), desk.path("runs/b.csv")).unwrap();
    let later = desk.path("runs/b-diagnosis/report.json");
    let begun = Instant::now();
    while !later.exists() {
        assert!(begun.elapsed() < PATIENCE, "{later:?}");
        std::thread::sleep(Duration::from_millis(200));
    }
    assert_eq!(fs::metadata(&report).unwrap().modified().unwrap(), written);
}
