//! Provenance of programs: the line that traces a program, or a setup sheet, back to its inputs. (book: program/gcode)

use std::borrow::Borrow;
use std::fmt::Debug;

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_toolpath::Program;

use crate::config::Settings;
use crate::posting::PostProcessor;

/// The part of the provenance that all programs of a run share.
#[derive(Clone, Debug)]
pub struct Provenances {
    /// All options besides the moves that influence a program's text.
    options: Vec<u8>,
    dialect: Option<Dialect>,
}

impl Provenances {
    /// Provenance of programs written with these settings, natively or through a post-processor.
    pub fn new(settings: &Settings, post_processor: Option<&PostProcessor>) -> Self {
        let general = &settings.general;
        let mut options = Vec::new();
        let mut add = |value: &dyn Debug| options.extend(format!("{value:?}\n").into_bytes());
        add(&(general.rapid.value, general.compatible.value));
        add(&(general.z_model.value, settings.z_split()));
        add(&(settings.comment_lang(), general.charset.value));
        options.extend(post_processor.map(PostProcessor::identity).unwrap_or_default());
        let dialect = match post_processor {
            None => Some(Dialect::Native),
            Some(post_processor) => post_processor.reader(),
        };
        Self { options, dialect }
    }

    /// Provenance of the programs in one file.
    pub fn of<P: Borrow<Program>>(&self, programs: &[P]) -> Provenance {
        Provenance::of_programs(programs, &self.options, self.dialect)
    }
}
