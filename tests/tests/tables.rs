//! This file says that the tables agree with their second transcription, and that the text's other numbers were weighed.

use rigproof_spec::geometry::{Angle, angle_ranges, arms};
use rigproof_spec::inertia::inertia;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::{Edge, backlash_width_deg, time_constant_fit, torque_gain_fit};
use rigproof_spec::units::{Unit, rad_from_deg, rad_s_from_rpm};

/// The rows of `spec/thesis/tables/<name>.csv`: leading words and numbers.
fn rows(name: &str, words: usize) -> Vec<(Vec<String>, Vec<f64>)> {
    let path = format!(
        "{}/../spec/thesis/tables/{name}.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader
        .records()
        .map(|record| {
            let record = record.unwrap();
            let text = record.iter().take(words).map(str::to_owned).collect();
            let numbers = record.iter().skip(words).map(|cell| cell.parse().unwrap());
            (text, numbers.collect())
        })
        .collect()
}

#[test]
fn table_3_1_agrees_with_its_second_transcription() {
    let table = rows("3.1", 1);
    assert_eq!(table.len(), Joint::ALL.len());
    for (joint, (words, numbers)) in Joint::ALL.into_iter().zip(table) {
        assert_eq!(words, [joint.letter()]);
        assert_eq!(numbers, [backlash_width_deg(joint)]);
    }
}

#[test]
fn table_3_2_agrees_with_its_second_transcription() {
    let table = rows("3.2", 1);
    assert_eq!(table.len(), Joint::ALL.len());
    for (joint, (words, numbers)) in Joint::ALL.into_iter().zip(table) {
        let fit = torque_gain_fit(joint);
        assert_eq!(words, [joint.letter()]);
        assert_eq!(
            numbers,
            [fit.k_1, fit.k_2, fit.k_3, fit.k_4, fit.k_5, fit.r_squared]
        );
    }
}

#[test]
fn table_3_3_agrees_with_its_second_transcription() {
    let keys = Edge::ALL
        .into_iter()
        .flat_map(|edge| Joint::ALL.map(|joint| (edge, joint)));
    let table = rows("3.3", 2);
    assert_eq!(table.len(), Edge::ALL.len() * Joint::ALL.len());
    for ((edge, joint), (words, numbers)) in keys.zip(table) {
        let fit = time_constant_fit(joint, edge);
        assert_eq!(words, [edge.name(), joint.letter()]);
        assert_eq!(
            numbers,
            [
                fit.a_avg_s,
                fit.a_1,
                fit.a_2,
                fit.a_3,
                fit.a_4,
                fit.a_5,
                fit.a_6,
                fit.r_squared
            ]
        );
    }
}

#[test]
fn table_4_1_agrees_with_its_second_transcription() {
    let cm = Unit::parse("cm").unwrap().to_si;
    let [three, four] = [Layout::ThreeBrake, Layout::FourBrake].map(arms);
    let table = rows("4.1", 1);
    let lengths = [
        ("L_AE", three.l_ae_m, four.l_ae_m),
        ("L_BC", three.l_bc_m, four.l_bc_m),
        ("L_ED", three.l_ed_m, four.l_ed_m),
        ("L_CD", three.l_cd_m, four.l_cd_m),
        ("L_AB", three.l_ab_m, four.l_ab_m),
    ];
    assert_eq!(table.len(), lengths.len());
    for ((name, three_m, four_m), (words, numbers)) in lengths.into_iter().zip(table) {
        assert_eq!(words, [name]);
        let [three_cm, four_cm] = numbers[..] else {
            panic!("{name}: {numbers:?}");
        };
        assert!((three_cm * cm - three_m).abs() < 1e-15 && (four_cm * cm - four_m).abs() < 1e-15);
    }
}

#[test]
fn table_4_2_agrees_with_its_second_transcription() {
    let table = rows("4.2", 1);
    assert_eq!(table.len(), Angle::ALL.len());
    for (words, numbers) in table {
        let angle = Angle::ALL
            .into_iter()
            .find(|angle| words == [angle.letter()])
            .unwrap();
        let printed = [Layout::ThreeBrake, Layout::FourBrake]
            .map(|layout| angle_ranges(layout).of(angle))
            .map(|range| [range.least_deg, range.greatest_deg]);
        assert_eq!(numbers, printed.concat());
    }
}

#[test]
fn step_law_gives_elapsed_time_with_its_labels_exchanged() {
    let (initial_nm, final_nm, a_s) = (0.31, 4.27, 0.0083);
    let mut printed_before = f64::INFINITY;
    for t_s in [0.0017, 0.0061, 0.0239] {
        let torque_nm = final_nm + (initial_nm - final_nm) * libm::exp(-t_s / a_s);
        //= thesis (3.4) test
        let law = |tau_1: f64, tau_2: f64| -libm::log((torque_nm - tau_1) / (tau_2 - tau_1));
        assert!((law(final_nm, initial_nm) - t_s / a_s).abs() < 1e-12);
        let printed = law(initial_nm, final_nm);
        assert!(printed < printed_before, "{printed} rises with time");
        printed_before = printed;
    }
}

#[test]
fn coil_is_slower_than_the_fitted_brake() {
    //= thesis (3.1) test
    let coil_s = 0.150 / 8.0;
    assert!((coil_s - 0.018_75_f64).abs() < 1e-15);
    for joint in Joint::ALL {
        for edge in Edge::ALL {
            assert!(time_constant_fit(joint, edge).a_avg_s < coil_s / 2.0);
        }
    }
}

#[test]
fn viscous_drag_at_60_rpm_exceeds_the_off_state_torque() {
    let viscous_nm_s_per_rad = 0.0082 / rad_s_from_rpm(1.0);
    assert!((viscous_nm_s_per_rad - 0.0783).abs() < 5e-5);
    let drag_nm = viscous_nm_s_per_rad * rad_s_from_rpm(60.0);
    assert!((drag_nm - 0.492).abs() < 1e-12);
    for joint in Joint::ALL {
        assert!(drag_nm > 1.8 * torque_gain_fit(joint).off_state_nm());
    }
}

#[test]
fn one_newton_metre_is_outside_the_95_percent_interval() {
    let greatest_deviation_nm = 0.4;
    let half_width_nm = 1.959_964 * greatest_deviation_nm;
    assert!((half_width_nm - 0.784_f64).abs() < 1e-4);
    assert!(1.0 > half_width_nm);
    // Two-sided probability of 2.5 standard deviations: 98.8 %, not 95 %.
    let inside = libm::erf(1.0 / greatest_deviation_nm / core::f64::consts::SQRT_2);
    assert!((inside - 0.9876).abs() < 5e-5);
}

#[test]
fn backlash_example_is_wider_than_quantization_explains() {
    let widest_deg = Joint::ALL
        .map(backlash_width_deg)
        .into_iter()
        .fold(0.0, f64::max);
    let count_deg = 360.0 / (1024.0 * 100.0);
    assert!((count_deg - 0.0035_f64).abs() < 2e-5);
    assert!(1.9 - widest_deg > 20.0 * count_deg);
}

#[test]
fn full_lockdown_leaves_less_than_a_square_centimetre() {
    // Arm lengths of table 5.1: AE 0.305 m (3-brake) and 0.264 m (4-brake), ED 0.305 m.
    assert_eq!(backlash_width_deg(Joint::A), 0.0);
    let turn_about_e_m = 0.305 * rad_from_deg(backlash_width_deg(Joint::E));
    assert!((turn_about_e_m - 0.009_05).abs() < 5e-6);
    let window_rad = rad_from_deg(backlash_width_deg(Joint::C));
    for arm_ae_m in [0.305, 0.264] {
        // The two arms sweep at most their product times both windows, at a right angle at E.
        let area_m2 = arm_ae_m * 0.305 * window_rad * window_rad;
        assert!(area_m2 < 1.0e-4, "{area_m2} m²");
    }
}

#[test]
fn table_5_1_agrees_with_its_second_transcription() {
    let path = format!(
        "{}/../spec/thesis/tables/5.1.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    let mut reader = csv::Reader::from_path(path).unwrap();
    let mut expected = Vec::new();
    for (name, layout) in [
        ("3-brake", Layout::ThreeBrake),
        ("4-brake", Layout::FourBrake),
    ] {
        let (inertia, arms) = (inertia(layout), arms(layout));
        for (arm, row, length_m) in [
            ("AE", inertia.ae, arms.l_ae_m),
            ("ED", inertia.ed, arms.l_ed_m),
            ("BC", inertia.bc, arms.l_bc_m),
            ("CD", inertia.cd, arms.l_cd_m),
        ] {
            let numbers = [row.mass_kg, row.inertia_kg_m2, length_m, row.centre_m];
            expected.push((name, arm, numbers.map(Some)));
        }
        expected.push((name, "AB", [None, None, Some(arms.l_ab_m), None]));
        expected.push((name, "D", [Some(inertia.payload_kg), None, None, None]));
    }
    let records: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert_eq!(records.len(), expected.len());
    for (record, (layout, component, numbers)) in records.iter().zip(expected) {
        assert_eq!([&record[0], &record[1]], [layout, component]);
        for (cell, number) in record.iter().skip(2).zip(numbers) {
            assert_eq!(cell.parse().ok(), number, "{layout} {component}: {cell}");
        }
    }
}
