//! This file says that a program in C gets from the monitor, bit for bit, what a program in Rust gets, with the numbers that one command wrote for both.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::Proportional;
use rigproof_impl::monitor::{Alarm, Monitor};
use rigproof_impl::path::Line;
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl_c::monitor_word;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::BLEND_BOUNDARY_M;

use crate::c_example::{answered, bits, compiled, line, samples};

#[path = "../monitor/rigproof_monitor.rs"]
mod numbers;

/// Both on the same samples and currents from so many samples on; the alarm.
fn agree(program: &std::path::Path, layout: Layout, told: &[Sensed<f64>]) -> Option<Alarm> {
    let (brakes, of) = match layout {
        Layout::ThreeBrake => ("3", numbers::THREE_BRAKE),
        Layout::FourBrake => ("4", numbers::FOUR_BRAKE),
    };
    let settings = Settings::thesis(layout);
    let path = Line::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let law = Proportional::new(Actuation::thesis(layout), path, BLEND_BOUNDARY_M, 497.0).unwrap();
    let mut tick = Tick::new(&settings, law).unwrap();
    let mut monitor = Monitor::new(&settings, &of).unwrap();
    let (mut lines, mut expected) = (String::new(), Vec::new());
    for sensed in told {
        let [a, e, b, c] = tick.tick(sensed).currents_a;
        lines += &format!("{} {a:?} {e:?} {b:?} {c:?}\n", line(sensed));
        expected.push(monitor.watch(sensed, [a, e, b, c]));
    }
    let answers = answered(program, &[brakes.to_owned()], lines);
    assert_eq!(answers.len(), expected.len());
    for (answer, expected) in answers.iter().zip(&expected) {
        let cells: Vec<&str> = answer.split(' ').collect();
        let [alarm, joint, faulty, a, e, b, c] = cells.as_slice() else {
            panic!("{answer}");
        };
        let (word, of_joint) = expected.alarm.map_or((0, -1), |alarm| {
            (monitor_word(alarm).0 as u32, monitor_word(alarm).1)
        });
        assert_eq!((alarm.parse(), joint.parse()), (Ok(word), Ok(of_joint)));
        assert_eq!(faulty.parse(), Ok(u32::from(expected.is_faulty)));
        let currents = [a, e, b, c].map(|cell| bits(cell));
        assert_eq!(currents, expected.currents_a.map(f64::to_bits));
    }
    monitor.alarm()
}

#[test]
fn the_monitor_in_c_agrees_bit_for_bit() {
    let Some(program) = compiled("examples/monitor.c") else {
        return;
    };
    let samples = samples();
    let mut alarms = Vec::new();
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        // Each begins elsewhere, with the numbers that its samples have.
        for from in [0, 700, 1900, 3100, 4300] {
            alarms.extend(agree(&program, layout, &samples[from..]));
        }
    }
    alarms.dedup();
    assert!(alarms.len() > 1, "{alarms:?}");
}
