//! G-code text: writing, reading, checking and post-processing programs.
