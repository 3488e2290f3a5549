//! Writes programs in the native dialect, with their probing programs and files of probe values, and reads them back. (book: program/gcode, book:
//! language/probes)

mod number;
mod program;
mod program_probe;
mod read_back;

pub(crate) use number::push_exact;
pub use number::{FIRST_PARAMETER, three_decimals, unused_probes};
pub use program::{
    WriteOptions, drawing_of_title, has_title, is_compatible, is_title, is_title_of, is_title_of_path,
    joined_paths, joined_title, left_out_lines, output_too_large_error, path_of_title, plain_title,
    probe_name, probing_program, title, values_file, write_program,
};
pub(crate) use program::{announces_probe, kind_of_label, stated_length};
pub(crate) use program_probe::{ProgramProbe, probe_entry};
pub use read_back::{
    OtherLine, Parts, contains_exact_moves, first_other_line, formula_differences, read_back,
    read_probing_back, unstated_heights,
};
