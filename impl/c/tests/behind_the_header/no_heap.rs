//! This file says that a tick takes nothing from the heap: an allocator that counts sees none of 10⁵ ticks of any law.
#![expect(unsafe_code, reason = "an allocator is unsafe to implement")]

use std::alloc::{GlobalAlloc, Layout as Memory, System};
use std::cell::Cell;

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{Law, Proportional, Sdof, VelocityRatio};
use rigproof_impl::number::Real;
use rigproof_impl::path::{Line, Polyline};
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::BLEND_BOUNDARY_M;

struct Counting;

thread_local! {
    static TAKEN: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: every call is the system's allocator's, and counting in a constant-initialised cell allocates nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, memory: Memory) -> *mut u8 {
        TAKEN.set(TAKEN.get() + 1);
        // SAFETY: the caller's promise is passed on.
        unsafe { System.alloc(memory) }
    }

    unsafe fn dealloc(&self, place: *mut u8, memory: Memory) {
        // SAFETY: the caller's promise is passed on.
        unsafe { System.dealloc(place, memory) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What 10⁵ ticks take from the heap, and in how many of them a brake acted.
fn taken<R: Real, L: Law<R>>(law: L) -> (u64, u32) {
    let mut tick = Tick::new(&Settings::thesis(Layout::FourBrake), law).unwrap();
    let before = TAKEN.get();
    let mut acted = 0;
    for number in 0..100_000_u32 {
        let wave = |period: f64| libm::sin(f64::from(number) / period);
        let command = tick.tick(&Sensed {
            // A sample is missed now and then.
            number: number + number / 977,
            counts: [
                33_400 + (4_931.0 * wave(223.7)) as i32,
                14_300 + (4_297.0 * wave(301.3)) as i32,
            ],
            tip_force_n: Vector::new(R::of(5.3 * wave(93.1)), R::of(4.1 * wave(71.9))),
        });
        acted += u32::from(
            command
                .currents_a
                .iter()
                .any(|current_a| *current_a > R::zero()),
        );
    }
    (TAKEN.get() - before, acted)
}

fn laws<R: Real>() -> [(u64, u32); 3] {
    let line = Line::<R>::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let chain = Polyline::<R, 4>::closed(&[[-0.1, 0.36], [0.11, 0.39], [0.03, 0.44]]).unwrap();
    let actuation = Actuation::<R>::thesis(Layout::FourBrake);
    [
        taken(Proportional::new(actuation, chain, BLEND_BOUNDARY_M, 497.0).unwrap()),
        taken(Sdof::new(actuation, line, BLEND_BOUNDARY_M, 0.0043).unwrap()),
        taken(VelocityRatio::new(actuation, line, BLEND_BOUNDARY_M, 3.7).unwrap()),
    ]
}

#[test]
fn a_tick_takes_nothing_from_the_heap() {
    let before = TAKEN.get();
    drop(std::hint::black_box(vec![1.7_f64; 9]));
    assert!(TAKEN.get() > before, "the allocator counts");
    for (taken, acted) in laws::<f64>().into_iter().chain(laws::<f32>()) {
        assert_eq!(taken, 0);
        assert!(acted > 1000, "{acted}");
    }
}
