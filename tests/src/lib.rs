//! Where the rooms meet. The tests stand in `tests/`.
