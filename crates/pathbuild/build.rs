//! Links the program at a fixed address on Linux: relocating a position-independent one at every start takes longer than compiling
//! most drawings does (benches/README.md, "Start").

#![expect(clippy::disallowed_methods, reason = "this is how cargo talks to a build script")]

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo:rustc-link-arg-bins=-no-pie");
    }
}
