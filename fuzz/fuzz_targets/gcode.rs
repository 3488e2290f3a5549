#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| pathbuild_fuzz::run("gcode", data));
