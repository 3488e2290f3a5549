//! Verifies many programs in one run, and caches the results for later runs. (book: reference/commands, `verify`)

use std::collections::{BTreeMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::catch_bugs;
use pathbuild_diagnostic::Diagnostic;

use super::{VerifiedProgram, Verifier, VerifyOptions};
use crate::common_findings::{number_warnings, unused_configurations};
use crate::files::ExtraInput;
use crate::memo::{Answer, Inputs, Memo, is_transient};
use crate::program;
use crate::session::Session;
use crate::workspace::Failure;

/// A request to verify programs.
#[derive(Debug)]
pub struct Request<'a> {
    /// The files and directories to verify.
    pub places: &'a [Utf8PathBuf],
    /// A program that is not in a file, for example from standard input, preceded by its name for messages. Its result is not cached.
    pub text: Option<(&'a Utf8Path, Vec<u8>)>,
    /// Options for reading the programs, for the stock, and for comparing with a drawing.
    pub options: VerifyOptions,
}

/// The outcome of a verification.
#[derive(Debug, Default)]
pub struct Verification {
    /// The programs with their results except for their diagnostics, in the order in which they were named.
    pub programs: Vec<(Utf8PathBuf, VerifiedProgram)>,
    /// Diagnostics of directories and of the programs.
    pub diagnostics: Vec<Diagnostic>,
}

impl Request<'_> {
    /// Verifies the programs that have no cached result. The session must trace inputs if results are to be cached.
    ///
    /// # Errors
    /// If programs cannot be verified at all, with the reason.
    pub fn run(self, session: &mut Session<'_>) -> Result<Verification, Failure> {
        let verifier = Verifier::new(session, self.options).map_err(|failure| match failure {
            Failure::Found(found) => Failure::Found(session.with_hints(found)),
            failure => failure,
        })?;
        let matches = session.match_programs(self.places, &|file| verifier.writers.is_program(file));
        let mut programs = verifier.verify_files(session, &matches.programs, &matches.directories);
        if let Some((name, text)) = self.text {
            programs.push((name.to_owned(), verifier.verify(name, text)));
        }
        let mut diagnostics = matches.problems;
        diagnostics.extend(unused_configurations_of_programs(
            session,
            &matches.programs,
            &matches.directories,
        ));
        for (_, verified) in &mut programs {
            diagnostics.append(&mut verified.diagnostics);
        }
        diagnostics.extend(warn_of_numbers(&programs));
        Ok(Verification { programs, diagnostics: session.with_hints(diagnostics) })
    }
}

/// Returns PB530 for programs in one directory with the same number, and for programs with a number that is reserved for macros.
fn warn_of_numbers(programs: &[(Utf8PathBuf, VerifiedProgram)]) -> Vec<Diagnostic> {
    let mut by_directory: BTreeMap<Option<&Utf8Path>, Vec<(u32, String, Utf8PathBuf)>> = BTreeMap::new();
    for (file, verified) in programs {
        let numbered = verified.number.zip(file.file_name());
        let numbered = numbered.map(|(number, name)| (number, name.to_owned(), file.clone()));
        by_directory.entry(file.parent()).or_default().extend(numbered);
    }
    by_directory.into_values().flat_map(|programs| number_warnings(&programs)).collect()
}

/// Returns PB526 as an error for each configuration beside or above programs that does not apply to them: the limits in it are those of the machine
/// that these programs are for.
fn unused_configurations_of_programs(
    session: &Session<'_>,
    programs: &[Utf8PathBuf],
    directories: &[Utf8PathBuf],
) -> impl Iterator<Item = Diagnostic> {
    let above: HashSet<&Utf8Path> = programs.iter().flat_map(|program| program.ancestors().skip(1)).collect();
    let directories: Vec<_> =
        directories.iter().filter(|directory| above.contains(directory.as_path())).cloned().collect();
    let unused = unused_configurations(session, &directories);
    unused.into_iter().map(Diagnostic::as_error)
}

impl Verifier<'_> {
    fn verify_files(
        &self,
        session: &Session<'_>,
        files: &[Utf8PathBuf],
        directories: &[Utf8PathBuf],
    ) -> Vec<(Utf8PathBuf, VerifiedProgram)> {
        let memo = Memo::of_programs(session, &self.query(session), files, directories);
        let traces: Vec<_> = self.against.iter().filter_map(|against| against.trace()).cloned().collect();
        let verify = |open: &[&Utf8PathBuf]| {
            if memo.is_some() {
                let known = files.len() - open.len();
                session.workspace().report_cached(["programs", "Programme"], known, files.len());
            }
            let verified = session.map_programs(open, |file| self.verify_file(file));
            let with_inputs = |(file, (program, hash)): (&&Utf8PathBuf, (VerifiedProgram, _))| {
                let is_transient = program.diagnostics.iter().any(is_transient);
                let further = vec![ExtraInput { path: session.normalize(file), hash }];
                (program, Inputs { traces: traces.clone(), further, is_transient, ..Inputs::default() })
            };
            open.iter().zip(verified).map(with_inputs).collect()
        };
        let subject = |file: &Utf8PathBuf| file.as_str().into();
        let answers = memo.get_or(files, subject, |_, result| Some(result), verify);
        memo.store_results(session, answers.iter().filter_map(Answer::fresh));
        files.iter().cloned().zip(answers.into_iter().map(|answer| answer.value)).collect()
    }

    /// Verifies a file. Also returns the hash of its bytes; `None` if it could not be read.
    fn verify_file(&self, file: &Utf8Path) -> (VerifiedProgram, Option<[u8; 32]>) {
        let failed = |problem: Box<Diagnostic>| VerifiedProgram {
            diagnostics: vec![problem.in_file(file)],
            ..VerifiedProgram::default()
        };
        match program::read(self.settings, &*self.system, file) {
            Ok(text) => {
                let hash = *blake3::hash(&text).as_bytes();
                (catch_bugs(|| self.verify(file, text)).unwrap_or_else(failed), Some(hash))
            }
            Err(problem) => (failed(problem), None),
        }
    }

    /// Returns the part of the cache key besides the program's file and the settings of `emit`.
    fn query(&self, session: &Session<'_>) -> String {
        let limits = &self.settings.limits;
        let limits = (limits.verify_cells.value, limits.verify_pieces.value);
        let identities = self.writers.identities();
        let drawing = self.against.as_ref().map(|against| session.normalize(against.file()));
        let parts = (&self.options, self.required(), self.lang, limits, &self.machine, identities, drawing);
        format!("verify {parts:?}")
    }
}
