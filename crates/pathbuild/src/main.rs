//! Compiles drawings of milling paths to G-code.
fn main() {}
