//! This file sets our reading of a large MCAP file beside the iteration of the format's own crate.
//!
//! `cargo run --profile bench -p rigproof-trace --example mcap_speed -- FILE`, with a file of `mcap_large`. Every way is a
//! function that is not inlined, so that `callgrind` counts the instructions of each.

use std::error::Error;
use std::fs::{self, File};
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use mcap::records::Record;
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{McapResult, Message};
use rigproof_trace::mcap::{Between, Selection, Wanted, read, read_from, summary};

/// How often every way is taken.
const ROUNDS: usize = 3;

/// The crate asks for small pieces; ours reads with a buffer of this size by itself.
fn buffered(path: &Path) -> Result<BufReader<File>, Box<dyn Error>> {
    Ok(BufReader::with_capacity(1 << 18, File::open(path)?))
}

/// The crate's iteration over messages: from a file, or from bytes that are in memory.
#[inline(never)]
fn crate_messages(path: &Path) -> Result<usize, Box<dyn Error>> {
    count(mcap::io::MessageReader::new(buffered(path)?))
}

#[inline(never)]
fn crate_messages_in_memory(bytes: &[u8]) -> Result<usize, Box<dyn Error>> {
    count(mcap::MessageStream::new(bytes)?)
}

fn count(
    messages: impl Iterator<Item = McapResult<Message<'static>>>,
) -> Result<usize, Box<dyn Error>> {
    let mut count = 0;
    for message in messages {
        let message = message?;
        count += usize::from(!message.data.is_empty() && message.log_time < u64::MAX);
    }
    Ok(count)
}

/// The crate's reader of records, no message put together: with the checks that ours has, or with none.
#[inline(never)]
fn crate_records(path: &Path, checked: bool) -> Result<usize, Box<dyn Error>> {
    let mut file = buffered(path)?;
    let options = LinearReaderOptions::default()
        .with_prevalidate_chunk_crcs(checked)
        .with_validate_data_section_crc(checked)
        .with_validate_summary_section_crc(checked)
        .with_record_length_limit(32 << 20);
    let mut reader = LinearReader::new_with_options(options);
    let mut count = 0;
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(need) => {
                let read = file.read(reader.insert(need))?;
                reader.notify_read(read);
            }
            LinearReadEvent::Record { data, opcode } => {
                if let Record::Message { header, data } = mcap::parse_record(opcode, data)? {
                    count += usize::from(!data.is_empty() && header.log_time < u64::MAX);
                }
            }
        }
    }
    Ok(count)
}

/// Our reading of two numbers of every message, every sum checked.
#[inline(never)]
fn ours(path: &Path) -> Result<usize, Box<dyn Error>> {
    Ok(read(path, &selection())?.trace.len())
}

#[inline(never)]
fn ours_in_memory(bytes: &[u8]) -> Result<usize, Box<dyn Error>> {
    let reading = read_from(bytes, Path::new("bytes"), &selection())?;
    Ok(reading.trace.len())
}

/// All numbers of every message summed up, as `inspect` does.
#[inline(never)]
fn ours_summed_up(path: &Path) -> Result<usize, Box<dyn Error>> {
    Ok(usize::try_from(summary(path)?.integrity.messages)?)
}

fn selection() -> Selection {
    let wanted = ["position[name=joint_2]", "effort[name=joint_4]"].map(|field| Wanted {
        address: format!("/joint_states.{field}"),
        between: Between::Line,
    });
    Selection {
        channels: wanted.to_vec(),
        time: None,
    }
}

/// Seconds that this thread has computed, where the system counts them: other programs do not disturb it.
fn cpu_s() -> Result<f64, Box<dyn Error>> {
    let times = fs::read_to_string("/proc/self/schedstat")?;
    let ns: f64 = times.split(' ').next().ok_or("no time")?.parse()?;
    Ok(ns * 1e-9)
}

/// Reads a file through and answers its messages.
type Way<'a> = dyn Fn() -> Result<usize, Box<dyn Error>> + 'a;

/// Times every way a few times in turn, the first one being the measure, and prints the least time of each.
fn race(title: &str, ways: &[(&str, &Way<'_>)]) -> Result<(), Box<dyn Error>> {
    let mut least_s = vec![f64::INFINITY; ways.len()];
    let mut counts = vec![0; ways.len()];
    for _ in 0..ROUNDS {
        for (way, (_, run)) in ways.iter().enumerate() {
            let start_s = cpu_s()?;
            counts[way] = run()?;
            least_s[way] = least_s[way].min(cpu_s()? - start_s);
        }
    }
    println!("  {title}: {} messages", counts[0]);
    for ((name, _), (s, count)) in ways.iter().zip(least_s.iter().zip(&counts)) {
        assert_eq!(*count, counts[0], "{name}");
        println!(
            "    {s:.2} s, {:4.0} % of the speed of the first: {name}",
            100.0 * least_s[0] / s
        );
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = PathBuf::from(std::env::args().nth(1).ok_or("name a file of mcap_large")?);
    race(
        "from a file",
        &[
            ("the crate's iteration over messages", &|| {
                crate_messages(&path)
            }),
            ("the crate's records", &|| crate_records(&path, false)),
            ("the crate's records, sums checked", &|| {
                crate_records(&path, true)
            }),
            ("ours, two numbers read, sums checked", &|| ours(&path)),
            ("ours, everything summed up, sums checked", &|| {
                ours_summed_up(&path)
            }),
        ],
    )?;
    let content = fs::read(&path)?;
    race(
        "from memory",
        &[
            ("the crate's iteration over messages", &|| {
                crate_messages_in_memory(&content)
            }),
            ("ours, two numbers read, sums checked", &|| {
                ours_in_memory(&content)
            }),
        ],
    )
}
