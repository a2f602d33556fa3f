//! This file reads files of one, four and sixteen times a size, each in a process of its own, and measures the memory and the time that it takes.

#[path = "bounds/encodings.rs"]
mod encodings;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use ::mcap::Compression;
use encodings::Encoding;
use hdf5_pure::FileBuilder;
use rigproof_trace::arrays::Arrays;
use rigproof_trace::mcap::{Between, Extras, Selection, Wanted};
use rigproof_trace::{Channel, Trace, csv, mcap};

/// The variable that tells the reading process what to read.
const FILE: &str = "RIGPROOF_BOUNDS_FILE";
/// What a process of the reader has of its own, MB: the program itself and the test around it.
const OWN_MB: f64 = 24.0;

/// In the name of a file of MCAP that another program could have written.
const FOREIGN: &str = "foreign";

/// What the handle of one dataset of HDF5 takes, MB.
const HANDLE_MB: f64 = 2.5 / 1024.0;

/// Reads everything of a file; the numbers that came out, or why it was refused.
fn numbers(file: &Path) -> Result<usize, String> {
    let is = |ending: &str| file.extension().is_some_and(|own| own == ending);
    let text = |error: rigproof_trace::TraceError| error.to_string();
    if is("csv") || is("gz") {
        let trace = csv::read(file).map_err(text)?;
        return Ok(trace.time_s.len() * (trace.channels.len() + 1));
    }
    if is("mcap") {
        let wanted = |address: &str| Wanted {
            address: address.to_owned(),
            between: Between::Line,
        };
        let is_foreign = file.to_string_lossy().contains(FOREIGN);
        let selection = Selection {
            channels: match is_foreign {
                true => encodings::ADDRESSES.map(wanted).to_vec(),
                false => Vec::new(),
            },
            time: None,
        };
        let read = mcap::read(file, &selection).map_err(text)?;
        return Ok(read.trace.time_s.len() * (read.trace.channels.len() + 1));
    }
    let arrays = Arrays::open(file).map_err(text)?.unwrap();
    let mut all = Vec::new();
    for entry in arrays.entries() {
        all.push(arrays.column(&entry.name).map_err(text)?);
    }
    Ok(all.iter().map(Vec::len).sum())
}

/// How long this thread has had a processor, s, where the system says: other programs do not count.
fn ran_s() -> Option<f64> {
    let words = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let ns: f64 = words.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * ns)
}

/// The process that reads: it prints what it took. Without the variable it is a test that reads nothing and holds.
#[test]
fn what_is_named_is_read() {
    let Some(file) = std::env::var_os(FILE) else {
        return;
    };
    let begun = Instant::now();
    let before_s = ran_s();
    let read = numbers(Path::new(&file));
    let time_s = ran_s().zip(before_s).map_or_else(
        || begun.elapsed().as_secs_f64(),
        |(after, before)| after - before,
    );
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let peak_kb = peak.and_then(|words| words.split_whitespace().next()?.parse::<f64>().ok());
    let (peak_kb, read) = (
        peak_kb.unwrap_or(0.0),
        read.map_err(|why| format!("refused: {why}")),
    );
    match read {
        Ok(count) => println!("took: {time_s} {peak_kb} {count}"),
        Err(why) => println!("took: {time_s} {peak_kb} {why}"),
    }
}

/// What reading took.
#[derive(Clone, Debug)]
struct Took {
    time_s: f64,
    peak_mb: f64,
    /// The numbers, or why it was refused.
    read: Result<usize, String>,
}

fn took(file: &Path, budget_mib: u64) -> Took {
    let answer = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "what_is_named_is_read", "--nocapture"])
        .env(FILE, file)
        .env(rigproof_trace::budget::VARIABLE, budget_mib.to_string())
        .output()
        .unwrap();
    let printed = String::from_utf8_lossy(&answer.stdout).into_owned();
    let line = printed.lines().find_map(|line| line.split_once("took: "));
    let (_, line) = line.unwrap_or_else(|| panic!("{file:?}: {printed} {answer:?}"));
    let mut words = line.splitn(3, ' ');
    let number = |word: Option<&str>| word.unwrap().parse::<f64>().unwrap();
    Took {
        time_s: number(words.next()),
        peak_mb: number(words.next()) / 1024.0,
        read: match words.next().unwrap() {
            refused if refused.starts_with("refused") => Err(refused.to_owned()),
            count => Ok(count.parse().unwrap()),
        },
    }
}

/// Reads three files of one kind; memory at most four times the larger of file and result beside its own, time at most a little more than sixteen times.
fn holds(kind: &str, files: [PathBuf; 3]) {
    holds_of(kind, files, 0);
}

/// As [`holds`], for a file that holds so many arrays for every size: the handle of each takes memory too.
fn holds_of(kind: &str, files: [PathBuf; 3], arrays: usize) {
    let all = files.each_ref().map(|file| took(file, 2048));
    for ((file, own), times) in files.iter().zip(&all).zip([1, 4, 16]) {
        let handles_mb = (arrays * times) as f64 * HANDLE_MB;
        let file_mb = file.metadata().unwrap().len() as f64 / f64::from(1 << 20);
        let result_mb = *own.read.as_ref().unwrap() as f64 * 8.0 / f64::from(1 << 20);
        let larger_mb = file_mb.max(result_mb);
        println!(
            "{kind:<28} file {file_mb:>6.1} MB, result {result_mb:>6.1} MB: {:>6.1} MB, {:.3} s",
            own.peak_mb, own.time_s
        );
        // Where the system does not say, it is 0.
        assert!(
            own.peak_mb < OWN_MB + handles_mb + 4.0 * larger_mb,
            "{kind}: {own:?}"
        );
    }
    let [one, _, sixteen] = &all;
    // What is quadratic takes 256 times. Below a fiftieth of a second the clock and the machine say nothing.
    assert!(
        sixteen.time_s < 0.02 + 64.0 * one.time_s.max(0.02),
        "{kind}: {all:?}"
    );
}

fn files(folder: &Path, name: &str, ending: &str, write: impl Fn(&Path, usize)) -> [PathBuf; 3] {
    [1, 4, 16].map(|times| {
        let file = folder.join(format!("{name}-{times}.{ending}"));
        write(&file, times);
        file
    })
}

/// A text of so many columns and lines.
fn text(columns: usize, lines: usize) -> Vec<u8> {
    let names: Vec<String> = (0..columns).map(|k| format!("c{k}")).collect();
    let mut text = format!("time (s),{}\n", names.join(",")).into_bytes();
    for k in 0..lines {
        let row = vec![format!("{}", k % 7 + 1); columns].join(",");
        writeln!(text, "{:.3},{row}", 0.001 * k as f64).unwrap();
    }
    text
}

#[test]
fn texts_take_memory_and_time_by_their_length_and_by_their_width() {
    let home = tempfile::tempdir().unwrap();
    let write = |columns: fn(usize) -> usize, lines: fn(usize) -> usize| {
        move |file: &Path, times: usize| {
            std::fs::write(file, text(columns(times), lines(times))).unwrap()
        }
    };
    holds(
        "text, many lines",
        files(home.path(), "long", "csv", write(|_| 3, |n| 20_000 * n)),
    );
    holds(
        "text, many columns",
        files(home.path(), "wide", "csv", write(|n| 2500 * n, |_| 40)),
    );
    let packed = |file: &Path, times: usize| {
        let fast = flate2::Compression::fast();
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), fast);
        packed.write_all(&text(3, 20_000 * times)).unwrap();
        std::fs::write(file, packed.finish().unwrap()).unwrap();
    };
    holds("text in gzip", files(home.path(), "packed", "csv", packed));
}

/// A run of so many columns and samples.
fn run(columns: usize, samples: usize) -> Trace {
    let channel = |k: usize| Channel {
        name: format!("c{k}"),
        unit: String::new(),
        samples: (0..samples).map(|n| (n * k % 11) as f64).collect(),
    };
    Trace {
        time_s: (0..samples).map(|k| 1e-3 * k as f64).collect(),
        channels: (0..columns).map(channel).collect(),
    }
}

#[test]
fn runs_in_mcap_take_memory_and_time_by_their_length_and_by_their_width() {
    let home = tempfile::tempdir().unwrap();
    let long = |file: &Path, times: usize| {
        mcap::write(file, &run(3, 15_000 * times), &Extras::default()).unwrap()
    };
    holds(
        "mcap, many samples",
        files(home.path(), "long", "mcap", long),
    );
    let wide = |file: &Path, times: usize| {
        mcap::write(file, &run(250 * times, 60), &Extras::default()).unwrap()
    };
    holds(
        "mcap, many columns",
        files(home.path(), "wide", "mcap", wide),
    );
}

#[test]
fn messages_of_every_encoding_take_memory_and_time_by_their_number() {
    let home = tempfile::tempdir().unwrap();
    let all = [
        ("mcap, JSON, zstd", Encoding::Json, Some(Compression::Zstd)),
        ("mcap, ROS 2, plain", Encoding::Ros2, None),
        ("mcap, ROS 1, LZ4", Encoding::Ros1, Some(Compression::Lz4)),
        (
            "mcap, Protobuf, zstd",
            Encoding::Protobuf,
            Some(Compression::Zstd),
        ),
    ];
    for (kind, encoding, packed) in all {
        let write = |file: &Path, times: usize| {
            encodings::messages(file, encoding, packed, 15_000 * times as u32)
        };
        let name = format!("{FOREIGN}-{encoding:?}");
        holds(kind, files(home.path(), &name, "mcap", write));
    }
}

/// A file of HDF5 with so many datasets of so many numbers.
fn hdf5(file: &Path, datasets: usize, numbers: usize) {
    let mut builder = FileBuilder::new();
    let values: Vec<f64> = (0..numbers).map(|k| 0.25 * k as f64).collect();
    for k in 0..datasets {
        let data = builder.create_dataset(&format!("x{k}"));
        data.with_f64_data(&values).with_shape(&[numbers as u64]);
    }
    builder.write(file).unwrap();
}

/// A file of MATLAB 5 with so many deflated variables of so many numbers.
fn matlab(file: &Path, variables: usize, numbers: usize) {
    let element = |kind: u32, bytes: &[u8]| {
        let mut out = [kind.to_le_bytes(), (bytes.len() as u32).to_le_bytes()].concat();
        out.extend_from_slice(bytes);
        if kind != 15 {
            out.resize(out.len().next_multiple_of(8), 0);
        }
        out
    };
    let mut out = b"MATLAB 5.0 MAT-file".to_vec();
    out.resize(124, b' ');
    out.extend_from_slice(b"\x00\x01IM");
    let real: Vec<u8> = (0..numbers)
        .flat_map(|k| libm::sin(0.37 * k as f64).to_le_bytes())
        .collect();
    for k in 0..variables {
        let sizes = [(numbers as i32).to_le_bytes(), 1_i32.to_le_bytes()].concat();
        let parts = [
            element(6, &[6, 0, 0, 0, 0, 0, 0, 0]),
            element(5, &sizes),
            element(1, format!("x{k}").as_bytes()),
            element(9, &real),
        ];
        let fast = flate2::Compression::fast();
        let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), fast);
        packed.write_all(&element(14, &parts.concat())).unwrap();
        out.extend(element(15, &packed.finish().unwrap()));
    }
    std::fs::write(file, out).unwrap();
}

#[test]
fn arrays_take_memory_and_time_by_their_length_and_by_their_number() {
    let home = tempfile::tempdir().unwrap();
    let of = |write: fn(&Path, usize, usize), many: bool| {
        move |file: &Path, times: usize| match many {
            true => write(file, 1250 * times, 20),
            false => write(file, 2, 100_000 * times),
        }
    };
    holds(
        "hdf5, many numbers",
        files(home.path(), "long", "h5", of(hdf5, false)),
    );
    holds_of(
        "hdf5, many datasets",
        files(home.path(), "many", "h5", of(hdf5, true)),
        1250,
    );
    holds(
        "matlab, many numbers",
        files(home.path(), "long", "mat", of(matlab, false)),
    );
    let newer = |file: &Path, times: usize| encodings::matlab_7_3(file, 100_000 * times);
    holds(
        "matlab 7.3, many numbers",
        files(home.path(), "newer", "mat", newer),
    );
    holds(
        "matlab, many variables",
        files(home.path(), "many", "mat", of(matlab, true)),
    );
}

/// A small file that announces or unpacks to much is refused by the budget, which it names, before the memory is taken.
#[test]
fn what_is_beyond_the_budget_is_refused_and_says_so() {
    let home = tempfile::tempdir().unwrap();
    let budget_mib = 64;
    let refused = |file: &Path| {
        let own = took(file, budget_mib);
        let why = own.read.unwrap_err();
        println!("{file:?}: {:.1} MB: {why}", own.peak_mb);
        assert!(
            why.contains("64 MiB") && why.contains(rigproof_trace::budget::VARIABLE),
            "{why}"
        );
        assert!(own.peak_mb < OWN_MB + budget_mib as f64, "{}", own.peak_mb);
    };
    let h5 = home.path().join("much.h5");
    hdf5(&h5, 1, 3_000_000);
    refused(&h5);
    let mat = home.path().join("much.mat");
    matlab(&mat, 40, 100_000);
    refused(&mat);
    // 2.3 million numbers, where a quarter of 64 MiB is 2.1 million.
    let mcap = home.path().join("much.mcap");
    mcap::write(&mcap, &run(8, 260_000), &Extras::default()).unwrap();
    refused(&mcap);
    let csv = home.path().join("much.csv");
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    packed.write_all(b"time (s),a,b,c,d,e,f,g\n").unwrap();
    for k in 0..400_000 {
        writeln!(packed, "{k},,,,,,,").unwrap();
    }
    std::fs::write(&csv, packed.finish().unwrap()).unwrap();
    assert!(csv.metadata().unwrap().len() < 2 << 20);
    refused(&csv);
}
