//! This file reads MCAP files that others wrote, where they are at hand.

use std::path::{Path, PathBuf};

use rigproof_trace::mcap::{self, Check, Summary};

/// A public file, or `None` with a printed line where there is none.
fn public(name: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let data = std::env::var_os("RIGPROOF_DATA").map_or(root.join("../shared/data"), PathBuf::from);
    let path = data.join("mcap").join(name);
    if path.exists() {
        return Some(path);
    }
    println!("passed over: the file {name} is not at hand, see docs/recordings.md");
    None
}

fn summary(name: &str) -> Option<Summary> {
    let summary = mcap::summary(&public(name)?).unwrap();
    println!("{name}\n  {}", summary.integrity.lines().join("\n  "));
    for topic in &summary.topics {
        println!(
            "  {} {} {}: {} messages, {} damaged, {:?}, step {:.6} s, {} gaps, lag {:?}, {} numbers",
            topic.name,
            topic.encoding,
            topic.type_name,
            topic.messages,
            topic.damaged,
            topic.unreadable,
            topic.step_s,
            topic.gaps,
            topic.lag_s,
            topic.channels.len()
        );
        for channel in topic.channels.iter().take(12) {
            println!(
                "    {} [{}] {} {}..{}",
                channel.address, channel.unit, channel.count, channel.minimum, channel.maximum
            );
        }
    }
    Some(summary)
}

#[test]
fn every_public_file_is_read_without_a_crash() {
    for name in [
        "array_msgs_0.mcap",
        "base_msgs_0.mcap",
        "compressed.mcap",
        "test_bag_mcap.mcap",
        "zstd_chunk_with_padding.mcap",
        "chunk_not_closed.mcap",
    ] {
        summary(name);
    }
    let _ = Check::Absent;
}
