//! This file says that the identification of a brake finds the tables that its recordings were made from.

mod bench;
mod recover;
