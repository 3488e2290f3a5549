//! Links the program at a fixed address on Linux: relocating a position-independent executable at every start takes longer than compiling
//! most drawings (benches/README.md, "Start"). With musl, the address is not fixed, because statically linked programs must be
//! position-independent to start.

#![expect(clippy::disallowed_methods, reason = "this is how cargo talks to a build script")]

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let target = |what: &str| std::env::var(format!("CARGO_CFG_TARGET_{what}")).unwrap_or_default();
    if target("OS") == "linux" && target("ENV") != "musl" {
        println!("cargo:rustc-link-arg-bins=-no-pie");
    }
}
