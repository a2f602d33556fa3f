//! This file holds the golden cases that are about the plant against it: brakes on the bench, and the tip let go.

use std::path::PathBuf;

use rigproof_impl::plant::brake::{Brake, Characteristic, Turn};
use rigproof_impl::plant::{Outcome, Scheme};
use rigproof_model::rig::Rig;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::brake_table;

use crate::budget::assert_within_budget;
use crate::impl_plant::rigs::plant_of;

const STEP_S: f64 = 1e-3;

/// A file of a case: its columns without their units, and its rows.
struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn read(path: PathBuf) -> Table {
        let mut file = csv::Reader::from_path(path).unwrap();
        let name = |heading: &str| heading.split(" (").next().unwrap().to_owned();
        let columns = file.headers().unwrap().iter().map(name).collect();
        let row =
            |row: Result<csv::StringRecord, _>| row.unwrap().iter().map(str::to_owned).collect();
        let rows = file.records().map(row).collect();
        Table { columns, rows }
    }

    /// The numbers of a column in the rows of a run.
    fn numbers(&self, run: usize, column: &str) -> Vec<f64> {
        let place = |name: &str| self.columns.iter().position(|other| other == name).unwrap();
        let (of, place, run) = (place("run"), place(column), run.to_string());
        let rows = self.rows.iter().filter(|row| row[of] == run);
        rows.map(|row| row[place].parse().unwrap()).collect()
    }
}

fn tables(case: &str) -> [Table; 2] {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../golden/cases")
        .join(case);
    ["input.csv", "expected.csv"].map(|file| Table::read(folder.join(file)))
}

#[test]
fn golden_brakes_are_the_plants() {
    let mut off = Vec::new();
    for joint in Joint::ALL {
        for kind in ["step", "sinusoid", "current"] {
            let case = format!("brake_{kind}_{}", joint.letter().to_lowercase());
            let [input, expected] = tables(&case);
            for run in 1.. {
                let numbers = |table: &Table, column| table.numbers(run, column);
                let times_s = numbers(&input, "time");
                if times_s.is_empty() {
                    break;
                }
                let (currents_a, speeds) = (numbers(&input, "current"), numbers(&input, "speed"));
                let yields_nm = numbers(&expected, "yield_torque");
                let rows_s = numbers(&expected, "time");
                let mut theta = numbers(&expected, "angle")[0];
                let table = brake_table(joint);
                let of = Characteristic::new(&table);
                let mut brake = Brake::new(&table, theta);
                let (mut row, mut tick) = (1, 0_u32);
                for (k, until_s) in times_s.iter().enumerate().skip(1) {
                    let (current_a, speed) = (currents_a[k - 1], speeds[k - 1]);
                    while (f64::from(tick) + 0.5) * STEP_S < *until_s {
                        // As the golden bench does, the angle is that at the end of the step.
                        let to = theta + speed * STEP_S;
                        let turn = Turn {
                            way_rad: [theta, to],
                            around_s: [0.0, STEP_S],
                            speed_rad_s: speed,
                            step_s: STEP_S,
                        };
                        brake.step(&of, current_a, &turn);
                        theta = to;
                        tick += 1;
                        if rows_s
                            .get(row)
                            .is_some_and(|row_s| (f64::from(tick) * STEP_S - row_s).abs() < 1e-9)
                        {
                            off.push((brake.yield_nm() - yields_nm[row]).abs());
                            row += 1;
                        }
                    }
                }
                assert_eq!(row, rows_s.len(), "{case}, run {run}");
            }
        }
    }
    println!("{} rows", off.len());
    assert_within_budget("plant_golden_brakes", off);
}

#[test]
fn golden_releases_are_the_plants() {
    let (mut tips_m, mut torques_nm) = (Vec::new(), Vec::new());
    let (mut held_as, mut rows) = (0, 0);
    for (layout, case) in [
        (Layout::ThreeBrake, "release_three_brake"),
        (Layout::FourBrake, "release_four_brake"),
    ] {
        let [input, expected] = tables(case);
        for run in 1.. {
            let one = |column: &str| input.numbers(run, column).first().copied();
            let (Some(start_x), Some(start_y)) = (one("start_x"), one("start_y")) else {
                break;
            };
            let cylinder_m = [one("cylinder_x").unwrap(), one("cylinder_y").unwrap()];
            let spring_n = one("spring_force").unwrap();
            let currents_a =
                ["current_a", "current_e", "current_b", "current_c"].map(|c| one(c).unwrap());
            let mut plant = plant_of(
                &Rig::new(layout, [start_x, start_y]).unwrap(),
                Scheme::Midpoint,
            );
            // The locked brake has had its current for a second.
            for _ in 0..1000 {
                assert_eq!(plant.step([0.0; 2], currents_a, STEP_S), Outcome::Moved);
            }
            let column = |name: &str| expected.numbers(run, name);
            let (times_s, x, y) = (column("time"), column("tip_x"), column("tip_y"));
            let torques = ["torque_a", "torque_e", "torque_b", "torque_c"].map(column);
            let held = ["held_a", "held_e", "held_b", "held_c"].map(column);
            for (row, time_s) in times_s.iter().enumerate().skip(1) {
                let ticks = libm::round((time_s - times_s[row - 1]) / STEP_S) as u32;
                for _ in 0..ticks {
                    // The pull in the middle of the step, as far as it is foreseen.
                    let tip_m = plant.tip_m() + plant.tip_velocity_m_s() * (0.5 * STEP_S);
                    let to = [cylinder_m[0] - tip_m.x, cylinder_m[1] - tip_m.y];
                    let away_m = libm::hypot(to[0], to[1]);
                    let force_n = to.map(|part| part / away_m * spring_n);
                    assert_eq!(plant.step(force_n, currents_a, STEP_S), Outcome::Moved);
                }
                let tip_m = plant.tip_m();
                tips_m.push(libm::hypot(tip_m.x - x[row], tip_m.y - y[row]));
                let stuck = plant.stuck();
                for i in 0..4 {
                    rows += 1;
                    let same = stuck[i] == (held[i][row] == 1.0);
                    held_as += usize::from(same);
                    if same && !stuck[i] {
                        torques_nm.push((plant.brake_torques_nm()[i] - torques[i][row]).abs());
                    }
                }
            }
        }
    }
    println!("held as in the reference: {held_as} of {rows} joints and rows");
    assert!(rows - held_as <= rows / 200, "{held_as} of {rows}");
    assert_within_budget("plant_golden_tip", tips_m);
    assert_within_budget("plant_golden_torque", torques_nm);
}
