//! This file joins what is claimed of the tick in C in one program, whose allocator counts what every thread takes.

mod c_example;
mod misuse;
mod monitored;
mod no_heap;
