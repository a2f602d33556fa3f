//! This file says which mutant is on: the one whose number is in the variable MUTANT; it becomes `impl/src/switch.rs` of the copy.
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
static MUTANT: AtomicU32 = AtomicU32::new(0);
#[inline(always)]
pub fn on() -> u32 {
    MUTANT.load(Relaxed)
}
#[used]
#[unsafe(link_section = ".init_array")]
static START: extern "C" fn() = start;
extern "C" fn start() {
    if let Ok(number) = std::env::var("MUTANT") {
        MUTANT.store(number.parse().unwrap(), Relaxed);
        std::panic::set_hook(Box::new(|info| {
            let text = info.to_string();
            let thread = std::thread::current();
            eprintln!(
                "KILLED {:?} {}",
                thread.name(),
                text.chars().take(300).collect::<String>()
            );
            std::process::exit(77);
        }));
    }
}
