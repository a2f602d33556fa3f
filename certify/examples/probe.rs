//! probe
#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::print_stdout, missing_docs)]
use rayon::prelude::*;
use rigproof_certify::built_in::{BuiltIn};
use rigproof_certify::left_out::LeftOut;
use rigproof_certify::monitor::{drill, middle::constants};
use rigproof_certify::plan::*;
use rigproof_certify::scenario::*;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::Method;

fn main() {
    let args: Vec<f64> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let (count, ticks) = (args[0] as u64, args[1] as u32);
    let memory = [args[2], args[3]]; let missed = [args[4], args[5]];
    let threshold = args[6]; let factor = args[7]; let from = args[8] as u32;
    for rig in if args[9] == 3.0 { vec![Rig::ThreeBrake] } else { vec![Rig::FourBrake] } {
        let plan = Plan { form: FORM, name: "x".into(), controller: Subject::built_in(BuiltIn::of(Method::ProportionalLow)), baseline: None, rigs: vec![rig], seed: 77, scenarios: count, ticks, calibration: None, search: 0, limits: [None;5], regressions: [None;5], least_met: 1, requirements: vec![] };
        let mut of = constants(&plan, rig).unwrap();
        of.memory_s = memory; of.missed_share = missed;
        let src = plan.controller.source().unwrap();
        let scen = |i: u64| { let mut s = plan.scenario(i); s.faults.clear(); s };
        let use_ = |i: u64| !matches!(plan.scenario(i).hand, rigproof_certify::hand::Hand::Adversary{..});
        // unchanged: max z by number
        let rows: Vec<_> = (0..count).into_par_iter().filter(|i| use_(*i)).map(|i| {
            let s = scen(i);
            let mut z = [-99.0f64; 10]; let mut sur = 0.0f64;
            let d = drill::run(&s, src, &of, None, |m, _, _, _| {
                for (k, n) in m.estimate().numbers().enumerate() { z[k] = z[k].max(n.beyond(of.low[k], of.high[k])); }
                sur = sur.max(m.estimate().surprise());
            }).unwrap();
            (d, z, sur, i)
        }).collect();
        let total: f64 = rows.iter().map(|r| r.0.ticks as f64).sum();
        println!("{rig:?} hours {:.2} surprise sorted {:?}", total/3.6e6, { let mut v: Vec<_> = rows.iter().map(|r| ((r.2*100.0).round()/100.0, r.3)).collect(); v.sort_by(|a,b| b.0.total_cmp(&a.0)); v.truncate(8); v });
        for k in 0..10 { let mut v: Vec<_> = rows.iter().map(|r| ((r.1[k]*100.0).round()/100.0, r.3)).collect(); v.sort_by(|a,b| b.0.total_cmp(&a.0)); v.truncate(6); println!("  {k}: {v:?}"); }
        // changed
        of.sigmas = [threshold; 10];
        for kind in 0..2 { for joint in Joint::ALL {
            if rig == Rig::ThreeBrake && joint == Joint::C { continue; }
            let half = if kind == 0 { 0.1 } else { of.high[4 + joint as usize] };
            let mut found = 0; let mut n = 0; let mut times = vec![]; let mut named = 0; let mut early = 0;
            let out: Vec<_> = (0..count).into_par_iter().filter(|i| use_(*i)).filter_map(|i| {
                let mut s = scen(i);
                let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
                if factor < 3.0 { s.plant.torque[joint as usize] = 0.0; }
                let effect = LeftOut { mechanism: if kind == 0 { Mechanism::GainError } else { Mechanism::DryOffset }, joint: Some(joint), parameters: vec![sign*factor*half] };
                s.ticks = ticks;
                let c = drill::Concealed { effect, from_tick: from, is_driven: kind == 0 };
                drill::run(&s, src, &of, Some(&c), |_, _, _, _| {}).map(|d| (d, c))
            }).collect();
            for (d, c) in out {
                if let Some((_, t)) = d.alarm && t < from { early += 1; continue; }
                let Some(f) = d.is_found(&c) else { continue };
                n += 1; if f { found += 1; times.push(d.excited_at_alarm);
                 let want = if kind == 0 { rigproof_impl::monitor::Alarm::Gain(joint) } else { rigproof_impl::monitor::Alarm::Friction(joint) }; if d.alarm.unwrap().0 == want { named += 1; } }
            }
            times.sort();
            println!("  {} {joint:?}: {found}/{n} within 2 s, {} ever, named {named}, early {early}; excited ms median {:?}", if kind == 0 {"gain"} else {"friction"}, times.len(), times.get(times.len()/2));
        } }
    }
}
