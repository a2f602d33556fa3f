//! This file reads MCAP files that others wrote, where they are at hand.

use std::path::{Path, PathBuf};

use rigproof_trace::mcap::{self, Check, Selection, Summary};

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

fn look(name: &str) -> Option<Summary> {
    let summary = mcap::summary(&public(name)?).unwrap();
    println!("{name}: {}", summary.integrity.lines().join("; "));
    Some(summary)
}

/// The greatest value of a number.
fn greatest(summary: &Summary, address: &str) -> f64 {
    let mut channels = summary.topics.iter().flat_map(|topic| &topic.channels);
    let channel = channels.find(|channel| channel.address == address);
    channel.map_or_else(
        || panic!("{address} is not in the file"),
        |channel| channel.maximum,
    )
}

#[test]
fn messages_of_ros_2_are_read_by_their_own_definitions() {
    let Some(summary) = look("array_msgs_0.mcap") else {
        return;
    };
    assert!(summary.integrity.is_whole(), "{:?}", summary.integrity);
    let unreadable = summary
        .topics
        .iter()
        .filter(|topic| topic.unreadable.is_some());
    assert_eq!(unreadable.count(), 0);
    for (address, expected) in [
        ("/one_shot/joint_state.position[name=joint2]", -0.5),
        ("/one_shot/joint_state.effort[name=joint3]", 10.3),
        ("/one_shot/imu.orientation_covariance[4]", 0.5),
    ] {
        assert_eq!(greatest(&summary, address), expected, "{address}");
    }
    let base = look("base_msgs_0.mcap").unwrap();
    assert_eq!(greatest(&base, "/one_shot/twist.angular.z"), -0.6);
    let bag = look("test_bag_mcap.mcap").unwrap();
    assert!(bag.topics.iter().all(|topic| topic.damaged == 0));
    assert_eq!(bag.integrity.chunks, Check::Absent);
}

#[test]
fn messages_of_ros_1_are_read_by_their_own_definitions() {
    let Some(summary) = look("compressed.mcap") else {
        return;
    };
    assert_eq!(
        (summary.integrity.data, summary.integrity.chunks),
        (Check::Verified, Check::Absent)
    );
    assert!(
        summary
            .topics
            .iter()
            .all(|topic| topic.damaged == 0 && topic.unreadable.is_none())
    );
    assert_eq!(
        greatest(&summary, "/tf.transforms[0].transform.translation.x"),
        3.835
    );
    let announced = summary.integrity.announced.unwrap();
    assert_eq!(
        (announced, summary.integrity.missing.len()),
        (summary.integrity.messages, 0)
    );
}

#[test]
fn messages_without_a_channel_are_counted_and_padding_is_passed_over() {
    let Some(summary) = look("zstd_chunk_with_padding.mcap") else {
        return;
    };
    // The file holds one chunk of messages and declares no channel.
    assert_eq!(
        (summary.integrity.chunks, summary.topics.len()),
        (Check::Verified, 0)
    );
    let missing = &summary.integrity.missing;
    assert!(
        missing[0].starts_with("12 messages belong to channels"),
        "{missing:?}"
    );
}

#[test]
fn a_file_whose_writer_was_stopped_says_what_is_missing() {
    let Some(summary) = look("chunk_not_closed.mcap") else {
        return;
    };
    let missing = summary.integrity.missing.join("\n");
    assert!(
        missing.contains("the chunk that starts at byte 39 was not closed: its writer was stopped; 0 messages were read from it"),
        "{missing}"
    );
    let path = public("chunk_not_closed.mcap").unwrap();
    let message = mcap::read(&path, &Selection::default())
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("holds no channel") && message.contains("was not closed"),
        "{message}"
    );
}
