//! This file holds faults of the time stamps of text files.

use super::{read, reads, rows};

#[test]
fn dates_and_times_of_day_are_time_stamps() {
    let stamped = |stamp: &dyn Fn(usize) -> String| {
        let rows = rows(";");
        let lines = rows.lines().enumerate().map(|(k, line)| {
            let (_, rest) = line.split_once(';').unwrap();
            format!("{};{rest}\n", stamp(k))
        });
        format!("time;x;u\n{}", lines.collect::<String>())
    };
    let fraction = |k: usize| 500 + 10 * k;
    for (text, said) in [
        (
            stamped(&|k| format!("2024-05-06 10:11:12.{}", fraction(k))),
            "dates with a time of day",
        ),
        (
            stamped(&|k| format!("2024-05-06T10:11:12.{}Z", fraction(k))),
            "dates with a time of day",
        ),
        (
            stamped(&|k| format!("06.05.2024 10:11:12.{}", fraction(k))),
            "dates with a time of day",
        ),
        (
            stamped(&|k| format!("10:11:12.{}", fraction(k))),
            "times of day",
        ),
        (
            stamped(&|k| format!("11:12.{}", fraction(k))),
            "times of day",
        ),
    ] {
        let remarks = reads("x", &text, 0.0);
        assert!(remarks.contains(said), "{remarks}");
    }
    let night = stamped(&|k| match k {
        0..20 => format!("23:59:59.{}", 800 + 10 * k),
        _ => format!("00:00:00.{:03}", 10 * (k - 20)),
    });
    let trace = read(night.as_bytes(), None).unwrap().trace;
    assert!((trace.time_s[29] - trace.time_s[0] - 0.29).abs() < 1e-9);
    let message = read(
        stamped(&|k| {
            if k == 5 {
                "noon".into()
            } else {
                format!("10:11:12.{}", fraction(k))
            }
        })
        .as_bytes(),
        None,
    );
    assert!(message.unwrap_err().contains(
        "line 7, column 1 `time`: the time stamp `noon` is no finite number and no date"
    ));
}

#[test]
fn stamps_since_1970_are_subtracted_to_their_last_digit() {
    let stamped = |head: &str, stamp: &dyn Fn(usize) -> String| {
        let rows = rows(",");
        let lines = rows.lines().enumerate().map(|(k, line)| {
            let (_, rest) = line.split_once(',').unwrap();
            format!("{},{rest}\n", stamp(k))
        });
        format!("{head},x,u\n{}", lines.collect::<String>())
    };
    let ms = |k: usize| 1_700_000_000_500 + 10 * k as u64;
    for (text, said) in [
        (
            stamped("t", &|k| format!("{}.{:03}", ms(k) / 1000, ms(k) % 1000)),
            "counted from 1700000000 s",
        ),
        (
            stamped("t (ms)", &|k| ms(k).to_string()),
            "counted from 1700000000 s",
        ),
        (
            stamped("time", &|k| ms(k).to_string()),
            "taken for ms since 1970: a guess",
        ),
        (
            stamped("%time", &|k| format!("{}000000", ms(k))),
            "taken for ns since 1970: a guess",
        ),
        (
            stamped("t", &|k| format!("1.{}E+09", &ms(k).to_string()[1..])),
            "counted from 1700000000 s",
        ),
    ] {
        let remarks = reads("x", &text, 0.0);
        assert!(remarks.contains(said), "{remarks}");
    }
    // The same numbers to the last bit, whatever the time is counted from.
    let late = read(
        stamped("t", &|k| format!("{}.{:03}", ms(k) / 1000, ms(k) % 1000)).as_bytes(),
        None,
    )
    .unwrap();
    let early = read(
        stamped("t", &|k| format!("0.{:03}", ms(k) % 1000)).as_bytes(),
        None,
    )
    .unwrap();
    assert_eq!(late.trace, early.trace);
}

#[test]
fn stamps_that_are_rounded_or_shared_are_put_on_their_grid() {
    let file = |stamp: &dyn Fn(f64) -> String, rate_hz: f64| {
        let rows = (0..900).map(|k| format!("{},{k}.5\n", stamp(f64::from(k) / rate_hz)));
        format!("t,x\n{}", rows.collect::<String>())
    };
    for (text, rate_hz, said) in [
        (
            file(&|t| format!("{t:.3}"), 800.0),
            800.0,
            "rounded to 0.001 s",
        ),
        (
            file(&|t| format!("{t:.6}"), 900.0),
            900.0,
            "rounded to 0.000001 s",
        ),
        (
            file(&|t| format!("{:.3}", t + 1.7e9), 1024.0),
            1024.0,
            "rounded to 0.001 s",
        ),
        (
            file(&|t| format!("{}", f64::from((t + 300.0) as f32)), 1000.0),
            1000.0,
            "single precision",
        ),
        (
            file(&|t| format!("{:.3}", (t * 125.0).floor() / 125.0), 1000.0),
            1000.0,
            "share a time stamp",
        ),
        (
            file(&|t| format!("10:11:{:02}", t as u32), 100.0),
            100.0,
            "rounded to 1 s",
        ),
    ] {
        let text = read(text.as_bytes(), None).unwrap();
        let time_s = text.trace.time_s;
        let rate = 899.0 / (time_s[899] - time_s[0]);
        let remarks = text.remarks.join("\n");
        assert!((rate / rate_hz - 1.0).abs() < 2e-3, "{rate} {remarks}");
        assert!(remarks.contains(said), "{remarks}");
        let steps: Vec<f64> = time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(
            steps.iter().all(|step| (step * rate - 1.0).abs() < 1e-6),
            "{remarks}"
        );
    }
    let twice = format!("t,x,u\n{}", rows(",").replace("0.620000,", "0.610000,"));
    assert!(
        read(twice.as_bytes(), None)
            .unwrap_err()
            .contains("line 14, column 1 `t`: the time stamp is repeated")
    );
    let back = format!("t,x,u\n{}", rows(",").replace("0.620000,", "0.120000,"));
    let message = read(back.as_bytes(), None).unwrap_err();
    assert!(
        message.contains("line 14, column 1 `t`: the time stamp 0.12 s goes backward after 0.61 s"),
        "{message}"
    );
}
