//! Our own dialect: writes a program, its probing program and the file of probe values. (book: program/gcode, book: language/probes)

mod comment;
mod drawn;
mod number;
mod program;
mod read_back;

pub(crate) use self::comment::{kind_of_label, stated_length};
pub use self::number::{FIRST_PARAMETER, unused_probes};
pub use self::program::{probe_name, probing_program, values_file};
pub use comment::{Charset, transliterated};
pub use drawn::{OtherLine, Parts, first_other_line, formula_differences, unstated_heights};
pub use number::f3;
pub(crate) use number::push_exact;
pub use program::{
    Header, WriteOptions, drawing_of_title, has_title, is_compatible, is_title, is_title_of, left_out_lines,
    path_of_title, plain_title, program, program_within, title, too_large,
};
pub use read_back::{is_read_back, read_back, read_probing_back};
