//! Watching: keeps checking, and writing programs, as drawings change. (book: reference/commands, `watch`)
//!
//! One loop: wait for changes, let them come to rest, take them over into the database as one revision, and ask again only those drawings that
//! the reverse index names. What is told carries the number of that revision. Those drawings are asked portion by portion: when more changes come
//! meanwhile, what is still open waits for them and is asked together with what they concern.

mod changes;
mod library;
mod names;
mod places;
mod reverse;
mod writing;

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use camino::Utf8PathBuf;
use pathbuild_db::SourceFile;
use pathbuild_diagnostic::Diagnostic;

use crate::Inputs;
use crate::emit::Delivered;
use crate::posting::PostProcessor;
use crate::session::Session;
use crate::workspace::Workspace;

pub use changes::Bell;
use changes::{Anew, Batch, Watcher};
use library::Library;
use writing::Writer;

/// What is to be watched.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Drawings, paths and directories; without any, the library.
    pub inputs: &'a Inputs,
    /// Whether the programs of `[emit] targets` are written.
    pub emits: bool,
    /// Whether the listener lists paths, for which it needs the post.
    pub lists: bool,
    /// Whether it is looked for changes from time to time, because the system tells none.
    pub polls: bool,
}

/// Hears what watching finds. The session is lent to who shows more than findings.
pub trait Listener {
    /// By what it can be woken from other threads.
    fn bell(&self, _: Bell) {}
    /// Drawings were found and read, and are to be checked; what is wrong with arguments and directories.
    fn found(&self, _: &mut Session<'_>, _: &[SourceFile], _: &[Diagnostic]) {}
    /// Drawings were checked, and their programs written where that is wanted, through that post.
    fn checked(&self, _: &mut Session<'_>, _: &[SourceFile], _: Option<&PostProcessor>) {}
    /// Somebody rang.
    fn rung(&self, _: &mut Session<'_>) {}
    /// Everything was checked for the first time.
    fn begun(&self, _: &Beginning) {}
    /// A batch of changes was worked on.
    fn updated(&self, _: &Update) {}
    /// Programs were written.
    fn written(&self, _: &[Delivered]) {}
    /// Programs cannot be written because nobody gives options that they need.
    fn refused(&self, _: &str) {}
}

/// How things stand at the beginning.
#[derive(Debug)]
pub struct Beginning {
    /// How many drawings there are.
    pub drawings: usize,
    /// How many paths are in them.
    pub paths: usize,
    /// Everything that was found.
    pub diagnostics: Vec<Diagnostic>,
    /// How long it took.
    pub time: Duration,
}

/// What came of a batch of changes.
#[derive(Clone, Debug)]
pub struct Update {
    /// The number of the batch, from 1.
    pub revision: u64,
    /// The files that changed.
    pub changed: BTreeSet<Utf8PathBuf>,
    /// Those of them that are no longer there.
    pub removed: BTreeSet<Utf8PathBuf>,
    /// What is wrong with arguments and directories, where that is something else than before; it is a part of `now` too.
    pub problems: Option<Vec<Diagnostic>>,
    /// Drawings that did not change, and were asked again because what was found in them may pass by itself; directories that can be listed
    /// again.
    pub tried_again: BTreeSet<Utf8PathBuf>,
    /// How many drawings were checked.
    pub checked: usize,
    /// How many are still to be checked, because more changes came.
    pub open: usize,
    /// What was found in these drawings before.
    pub before: Vec<Diagnostic>,
    /// What is found in them now.
    pub now: Vec<Diagnostic>,
    /// How long it took.
    pub time: Duration,
}

/// Why watching ended.
#[derive(Debug)]
pub enum Ended {
    /// No more changes will come, or somebody ended it.
    Over,
    /// The configuration, or a file of the post that it names, changed: everything has to begin anew.
    ConfigurationChanged,
    /// A directory that is watched, or leads to one, came, went or is another one: the system watches the one before, or none.
    DirectoriesChanged,
    /// Nothing is named, and the configuration has no library.
    NothingNamed,
    /// Programs are to be written, and the configuration names no targets.
    NoTargets,
    /// What is wrong with the post.
    BadPost(Vec<Diagnostic>),
    /// The system does not tell changes.
    CannotWatch(String),
}

impl Request<'_> {
    /// Watches until nothing more can come.
    pub fn run(&self, workspace: &Workspace, listener: &dyn Listener) -> Ended {
        let session = Session::traced(workspace);
        if self.inputs.inputs.is_empty() && !session.has_library() {
            return Ended::NothingNamed;
        }
        let writer = match Writer::new(workspace, listener, self) {
            Ok(writer) => writer,
            Err(problems) => return Ended::BadPost(problems),
        };
        if self.emits && workspace.settings.emit.targets.value.is_empty() {
            return Ended::NoTargets;
        }
        // Before anything is read, so that no change is missed.
        match Watcher::new(&session, self, &writer.sources()) {
            Ok(watcher) => {
                let library = Library::new(session, self.inputs);
                Watching { listener, library, writer, watcher, revision: 0 }.run()
            }
            Err(reason) => Ended::CannotWatch(reason.to_string()),
        }
    }
}

/// A library while it is watched.
struct Watching<'a> {
    listener: &'a dyn Listener,
    library: Library<'a>,
    writer: Writer<'a>,
    watcher: Watcher,
    revision: u64,
}

/// So many drawings are asked at the beginning before somebody who rang is heard.
const FIRST_PORTION: usize = 512;

/// So many drawings are asked before it is looked whether there is news.
const PORTION: usize = 64;

impl Watching<'_> {
    fn run(mut self) -> Ended {
        self.listener.bell(self.watcher.bell());
        self.begin();
        loop {
            match self.watcher.next(&self.library) {
                Batch::Anew(Anew::Configuration) => return Ended::ConfigurationChanged,
                Batch::Anew(Anew::Directories) => return Ended::DirectoriesChanged,
                Batch::Over => return Ended::Over,
                Batch::Rung => self.listener.rung(self.library.session_mut()),
                Batch::Changes(changes) => self.update(&changes),
            }
        }
    }

    fn begin(&mut self) {
        let begun = Instant::now();
        let mut found = self.library.find();
        let drawings: Vec<SourceFile> = self.library.open().collect();
        self.listener.found(self.library.session_mut(), &drawings, &found.now);
        while self.library.is_behind() && !self.watcher.is_over(self.library.session()) {
            let portion = self.library.ask_portion(FIRST_PORTION, &mut found);
            self.tell(&portion);
        }
        let written = self.writer.begin(self.library.session_mut(), &found.asked);
        let programs = self.writer.written(self.library.session(), &found.asked);
        if !programs.is_empty() {
            self.tell(&programs);
        }
        let time = begun.elapsed();
        let (drawings, paths) = self.library.counts();
        let diagnostics = self.library.session().with_hints([found.now, written].concat());
        self.listener.begun(&Beginning { drawings, paths, diagnostics, time });
    }

    fn update(&mut self, changes: &changes::Changes) {
        let found = self.library.take_over(changes);
        if !self.library.is_behind() && !found.has_news() {
            return;
        }
        self.revision += 1;
        let asked = self.work_on(found);
        // It may take as long as it is allowed to: whoever changed something does not wait for it.
        if !self.library.is_behind() && !self.watcher.has_news(self.library.session()) {
            let again = self.library.try_again(&self.writer.passing(), &asked);
            if self.library.is_behind() || again.has_news() {
                self.work_on(again);
            }
        }
    }

    /// Asks what is open, writes its programs, and tells what came of it; which drawings were asked.
    fn work_on(&mut self, mut found: library::Batch) -> Vec<SourceFile> {
        let begun = Instant::now();
        found.before.extend(self.writer.release(self.library.session(), self.library.open(), &found.removed));
        let mut written = Vec::new();
        while self.library.is_behind() {
            let portion = self.library.ask_portion(PORTION, &mut found);
            let writing = self.writer.write(self.library.session_mut(), &portion);
            found.before.extend(writing.before);
            written.extend(writing.now);
            self.tell(&portion);
            // What is still open may be something else by now.
            if self.watcher.has_news(self.library.session()) {
                break;
            }
        }
        self.library.leave(&mut found);
        let time = begun.elapsed();
        let library::Batch { changed, asked, open, removed, tried_again, before, now, problems } = found;
        let session = self.library.session();
        self.listener.updated(&Update {
            revision: self.revision,
            changed,
            removed,
            problems,
            tried_again,
            checked: asked.len(),
            open,
            before: session.with_hints(before),
            now: session.with_hints([now, written].concat()),
            time,
        });
        asked
    }

    /// Tells what was checked, and hears who rang meanwhile.
    fn tell(&mut self, checked: &[SourceFile]) {
        let session = self.library.session_mut();
        self.listener.checked(session, checked, self.writer.poster());
        _ = self.watcher.is_over(session);
        if self.watcher.has_been_rung() {
            self.listener.rung(session);
        }
    }
}
