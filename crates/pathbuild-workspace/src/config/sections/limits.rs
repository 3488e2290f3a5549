//! `[limits]`: upper bounds on sizes and times. PB005 names the key if one is exceeded.

use std::time::Duration;

use crate::config::kinds::{COUNT, SECONDS, SIZE};

/// Like [`section!`], for values that an untrusted configuration may lower but not raise.
macro_rules! limits {
    ($(
        $(#[doc = $meaning:literal])+
        $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $results:ident;
    )*) => {
        section! {
            $($(#[doc = $meaning])+ $field: $type = $name, $kind, $default, $example, $results;)*
        }

        impl Options {
            /// Reads the limits. Reports those of an untrusted configuration that exceed their defaults.
            pub(in crate::config) fn read_lowered(table: &mut Table<'_, '_, '_>) -> Self {
                let options = Self::read(table);
                $(if table.is_untrusted() && options.$field.as_ref().is_some_and(|limit| limit.value > $default) {
                    table.report_raised($name, $example);
                })*
                options
            }
        }
    };
}

limits! {
    /// largest drawing
    file_size: u64 = "file-size", SIZE, 256 << 20, r#""256 MiB""#, Check;
    /// largest number of entities in a drawing
    entities: u64 = "entities", COUNT, 2_000_000, "2_000_000", Check;
    /// largest number of moves of a program, with everything that it embeds
    embedding_moves: u64 = "embedding-moves", COUNT, 50_000_000, "50_000_000", Check;
    /// memory that the moves of one program may take
    program_memory: u64 = "program-memory", SIZE, 1 << 30, r#""1 GiB""#, Check;
    /// largest program that is written
    output_size: u64 = "output-size", SIZE, 256 << 20, r#""256 MiB""#, Emit;
    /// largest number of cells of the material map that `verify` visits
    verify_cells: u64 = "verify-cells", COUNT, 1_000_000_000, "1_000_000_000", Neither;
    /// largest number of pieces into which `verify` divides arcs and slopes, to follow the material
    verify_pieces: u64 = "verify-pieces", COUNT, 5_000_000, "5_000_000", Neither;
    /// largest number of different paths, each with its values, in a program
    embedded_paths: u64 = "embedded-paths", COUNT, 100_000, "100_000", Check;
    /// largest number of files and directories below a searched directory, and in a Git revision
    library_entries: u64 = "library-entries", COUNT, 200_000, "200_000", Neither;
    /// largest .gitignore or .ignore file
    ignore_file_size: u64 = "ignore-file-size", SIZE, 64 << 10, r#""64 KiB""#, Neither;
    /// largest number of characters in a parameter text
    text_length: u64 = "text-length", COUNT, 65_536, "65_536", Check;
    /// longest time for one path
    seconds_per_path: Duration = "seconds-per-path", SECONDS, Duration::from_mins(1), "60", Check;
}

impl Settings {
    /// Upper bound on the size of an output file in bytes.
    pub fn output_size(&self) -> usize {
        usize::try_from(self.output_size.value).unwrap_or(usize::MAX)
    }
}
