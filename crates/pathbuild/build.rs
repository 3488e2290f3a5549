//! Links the program at a fixed address on Linux: relocating a position-independent one at every start takes longer than compiling
//! most drawings does (benches/README.md, "Start"). Not with musl: what is linked statically there starts as a position-independent
//! program only.

#![expect(clippy::disallowed_methods, reason = "this is how cargo talks to a build script")]

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let target = |what: &str| std::env::var(format!("CARGO_CFG_TARGET_{what}")).unwrap_or_default();
    if target("OS") == "linux" && target("ENV") != "musl" {
        println!("cargo:rustc-link-arg-bins=-no-pie");
    }
}
