#![allow(missing_docs, clippy::all)]
use rigproof_diagnose::{align::*, problem::*, regression::*, run::*, select::*, weak::*};
use rigproof_spec::effect::Mechanism::*;
use std::time::Instant;
fn csv(p: &str) -> Vec<Vec<f64>> {
    let t = std::fs::read_to_string(p).unwrap();
    let mut c: Vec<Vec<f64>> = vec![];
    for l in t.lines().skip(1) {
        for (k, x) in l.split(',').enumerate() {
            if c.len() <= k {
                c.push(vec![])
            }
            c[k].push(x.trim().parse().unwrap_or(f64::NAN));
        }
    }
    c
}
fn main() {
    let which = std::env::args().nth(1).unwrap();
    let d = "/work/shared/data/";
    let (s, inertia, nominal) = if which == "emps" {
        let c = csv(&format!("{d}emps/DATA_EMPS.csv"));
        (
            Signals {
                plant: PlantKind::Axis,
                time_s: c[0].clone(),
                position: c[2].clone(),
                effort: c[3].iter().map(|v| v * 35.15065188).collect(),
                predicted: None,
                current: None,
                held: which == "emps",
                position_quantum: None,
                position_noise: None,
                effort_noise: None,
                effort_limit: None,
            },
            Inertia::Unknown(100.0),
            vec![NominalEffect {
                mechanism: Viscous,
                parameters: vec![0.0],
                unknown: true,
                onset_s: None,
            }],
        )
    } else if which == "bw" {
        let c = csv("/tmp/py/bw_train.csv");
        (
            Signals {
                plant: PlantKind::Axis,
                time_s: c[0].clone(),
                position: c[2].clone(),
                effort: c[1].clone(),
                predicted: None,
                current: None,
                held: which == "emps",
                position_quantum: Some(0.0),
                position_noise: Some(7.6e-6),
                effort_noise: Some(0.0),
                effort_limit: None,
            },
            Inertia::Unknown(2.0),
            vec![
                NominalEffect {
                    mechanism: Viscous,
                    parameters: vec![0.0],
                    unknown: true,
                    onset_s: None,
                },
                NominalEffect {
                    mechanism: Spring,
                    parameters: vec![0.0],
                    unknown: true,
                    onset_s: None,
                },
            ],
        )
    } else {
        let c = csv(&format!("{d}mr_damper/{which}.csv"));
        let i0 = c[1]
            .iter()
            .position(|x| (x - c[1][0]).abs() > 0.5)
            .unwrap_or(0);
        let cut = |v: &Vec<f64>| v[i0..].to_vec();
        (
            Signals {
                plant: PlantKind::Bench,
                time_s: cut(&c[0]),
                position: cut(&c[1]).iter().map(|x| x * 1e-3).collect(),
                effort: cut(&c[2]),
                predicted: None,
                current: None,
                held: which == "emps",
                position_quantum: None,
                position_noise: None,
                effort_noise: None,
                effort_limit: None,
            },
            Inertia::None,
            [DryOffset, Viscous, ConstantBias]
                .map(|m| NominalEffect {
                    mechanism: m,
                    parameters: vec![0.0],
                    unknown: true,
                    onset_s: None,
                })
                .to_vec(),
        )
    };
    let t0 = Instant::now();
    let run = align(&s).unwrap();
    let band = band_hz(&run.effort, run.step_s);
    let j = if let Inertia::Unknown(x) = inertia {
        x
    } else {
        0.0
    };
    let width = choose_width(&run, j, band);
    println!(
        "n {} step {} band {band:.2} Hz width {width} floor speed {:.2e} pos noise {:.2e} eff noise {:.2e}",
        run.len(),
        run.step_s,
        run.speed_floor,
        run.position_noise,
        run.effort_noise
    );
    let windows = Windows::new(&run, width);
    println!(
        "windows {} usable {}",
        windows.centres.len(),
        windows.usable.iter().filter(|u| **u).count()
    );
    let mut p = Problem::new(&run, windows, inertia);
    let terms = nominal.iter().map(|n| p.nominal_term(n).unwrap()).collect();
    let sel = select(&mut p, terms, Gates::default());
    let us = |r: &Vec<f64>| {
        let v: Vec<f64> = r
            .iter()
            .zip(&p.windows.usable)
            .filter(|x| *x.1)
            .map(|x| *x.0)
            .collect();
        rms(&v)
    };
    println!(
        "before {:.4} after {:.4} floor {:.5}  white loss {:.0} -> {:.0}",
        us(&sel.before.residual),
        us(&sel.after.residual),
        p.floor,
        sel.before.left_out(),
        sel.after.left_out()
    );
    println!(
        "coef {:?} redundant {:?}",
        sel.after.coefficients, sel.after.redundant
    );
    for s in &sel.stages {
        println!(
            "  + {:?} -> {:?} rms {:.3}",
            s.entered, s.standing, s.residual
        );
    }
    for f in &sel.found {
        println!(
            "  {:?} shape {:?} onset {:?} z {:.1} share {:.3}",
            f.term.mechanism, f.term.shape, f.term.onset_s, f.z, f.share
        );
    }
    println!("{:?}", t0.elapsed());
    if which == "emps" {
        use rigproof_diagnose::{refit::*, simulate::*};
        let c = csv(&format!("{d}emps/DATA_EMPS_PULSES.csv"));
        let mut s2 = s.clone();
        s2.time_s = c[0].clone();
        s2.position = c[2].clone();
        s2.effort = c[3].iter().map(|v| v * 35.15065188).collect();
        let test = align(&s2).unwrap();
        let e = |m, p: &[f64]| Effect {
            mechanism: m,
            parameters: p.to_vec(),
            onset_s: None,
        };
        let base = vec![
            e(Viscous, &[203.0]),
            e(DryOffset, &[20.4]),
            e(DirectionAsymmetry, &[-37.0, -0.2]),
        ];
        for extra in [
            vec![],
            vec![e(BiasDrift, &[0.0])],
            vec![e(BiasDrift, &[0.0]), e(Lag, &[0.0007])],
            vec![e(BiasDrift, &[0.0]), e(Stribeck, &[1.0, 0.005])],
            vec![e(BiasDrift, &[0.0]), e(Presliding, &[5.0, 5e-5])],
            vec![e(BiasDrift, &[0.0]), e(Ripple, &[1.0, -0.3, 0.0025011695])],
        ] {
            let plant = Plant {
                inertia: 95.1,
                effects: base.iter().cloned().chain(extra).collect(),
            };
            let mut free = vec![Free {
                place: None,
                scale: 3.0,
            }];
            for (k, ef) in plant.effects.iter().enumerate() {
                let n = rigproof_model::effects::entry(ef.mechanism).unwrap().linear;
                for j in 0..n {
                    free.push(Free {
                        place: Some((k, j)),
                        scale: (0.05 * ef.parameters[j].abs()).max(0.02),
                    })
                }
            }
            extra::go(&run, Some(&test), plant, free, Protocol::default());
        }
    }
    let _ = Blocks::new(&p);
}
mod extra {
    use super::*;
    use rigproof_diagnose::{refit::*, simulate::*};
    pub fn go(run: &Run, test: Option<&Run>, plant: Plant, free: Vec<Free>, protocol: Protocol) {
        let t = Instant::now();
        let r = refit(&plant, &free, run, &protocol);
        println!(
            "refit {:.5e} -> {:.5e}  {:?} in {:?}",
            r.before,
            r.after,
            r.plant,
            t.elapsed()
        );
        if let Some(test) = test {
            println!(
                "test before {:.5e} after {:.5e}",
                error_rms(&plant, test, &protocol),
                error_rms(&r.plant, test, &protocol)
            );
        }
    }
}
