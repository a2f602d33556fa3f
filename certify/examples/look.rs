//! look
#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::print_stdout, missing_docs)]
use rigproof_certify::built_in::{BuiltIn};
use rigproof_certify::monitor::{drill, middle::constants};
use rigproof_certify::plan::*;
use rigproof_certify::scenario::*;
use rigproof_spec::methods::Method;
fn main() {
    let args: Vec<f64> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let rig = if args[0] == 3.0 { Rig::ThreeBrake } else { Rig::FourBrake };
    let plan = Plan { form: FORM, name: "x".into(), controller: Subject::built_in(BuiltIn::of(Method::ProportionalLow)), baseline: None, rigs: vec![rig], seed: 77, scenarios: 100, ticks: 90000, calibration: None, search: 0, limits: [None;5], regressions: [None;5], least_met: 1, requirements: vec![] };
    let mut of = constants(&plan, rig).unwrap(); of.memory_s=[300.0,1.0]; of.missed_share=[0.02,0.04]; let k = args[2] as usize; let z = |m: &rigproof_impl::monitor::Monitor| m.estimate().numbers().nth(k).unwrap().beyond(of.low[k], of.high[k]);
    let mut s = plan.scenario(args[1] as u64); s.faults.clear();
    let src = plan.controller.source().unwrap();
    println!("{:?} {:?}", s.hand, s.plant);
    let mut best = (0.0, 0);
    drill::run(&s, src, &of, None, |m, _, _, t| { if z(m) > best.0 { best = (z(m), t); } });
    println!("max {best:?}");
    let mut last = 0.0;
    drill::run(&s, src, &of, None, |m, p, a, t| {
        let new = m.estimate().surprise() != last; last = m.estimate().surprise();
        if new && t + 3000 > best.1 && t < best.1 + 20 {
            let (y, open, ins) = m.dbg();
            println!("{t} {} z {:.2} {:.4?} sur {:.2} open {open:04b} I {a:.2?} w {:.3?} stuck {:?} y {:.3?} model {y:.3?} in {:?} model {ins:?}", if new {"*"} else {" "}, z(m), m.estimate().numbers().nth(k).map(|n| (n.learned, n.doubt.sqrt(), n.change, n.variance.sqrt())), last, p.joint_rates_rad_s(), p.stuck().map(u8::from), p.yield_torques_nm(), p.brakes().map(|b| b.backlash().is_inside()));
        }
    });
}
