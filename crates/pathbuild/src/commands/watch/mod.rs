//! `pathbuild watch`: keeps checking, and writing with `--emit`, as drawings change. (spec/05-command-line.md)
//!
//! One loop: wait for changes, let them come to rest, take them over into the database as one revision, and ask again only those drawings that
//! the reverse index names. What is shown carries the number of that revision. Those drawings are asked portion by portion: when more changes come
//! meanwhile, what is still open waits for them and is asked together with what they concern.

mod changes;
mod library;
mod reverse;
mod show;
mod writing;

use std::time::Instant;

use crate::args::WatchArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::session::Session;

use changes::{Batch, Watcher};
use library::Library;
use writing::Writer;

/// Why watching ended.
#[derive(Debug)]
pub enum Ended {
    /// Nothing can be watched.
    With(ExitStatus),
    /// The configuration, or a file of the post that it names, changed: everything has to begin anew.
    ConfigurationChanged,
}

/// Runs the command.
pub fn run(context: &Context, args: &WatchArgs) -> Ended {
    let session = Session::traced(context);
    if args.inputs.inputs.is_empty() && !session.has_library() {
        return Ended::With(context.nothing_named("watch"));
    }
    let mut writer = match Writer::new(context, args.emit) {
        Ok(writer) => writer,
        Err(problems) => return Ended::With(context.fail(problems)),
    };
    if let Some(refusal) = writer.refusal() {
        return Ended::With(context.usage(&refusal));
    }
    // Before anything is read, so that no change is missed.
    let watcher = Watcher::new(context, &session, args, &writer.sources());
    let mut watcher = match watcher {
        Ok(watcher) => watcher,
        Err(reason) => {
            let advice = context.choose(
                "--poll looks for changes from time to time",
                "--poll sieht von Zeit zu Zeit nach Änderungen",
            );
            return Ended::With(context.usage(&format!("cannot watch: {reason}; {advice}")));
        }
    };
    let begun = Instant::now();
    let mut library = Library::new(context, session, &args.inputs);
    let update = library.begin();
    let written = writer.begin(library.session_mut(), &update.asked);
    show::begun(context, &library, update, written, begun.elapsed());
    let mut revision = 0;
    loop {
        match watcher.next(&library) {
            Batch::ConfigurationChanged => return Ended::ConfigurationChanged,
            Batch::Over => return Ended::With(ExitStatus::Success),
            Batch::Changes(changes) => {
                let begun = Instant::now();
                let mut update = library.take_over(&changes);
                if !library.is_behind() && update.removed.is_empty() {
                    continue;
                }
                revision += 1;
                writer.release(library.session(), library.open(), &update.removed);
                let mut written = Vec::new();
                while library.is_behind() {
                    let portion = library.ask_portion(&mut update);
                    written.extend(writer.write(library.session_mut(), &portion));
                    // What is still open may be something else by now.
                    if watcher.has_news(library.session()) {
                        break;
                    }
                }
                library.leave(&mut update);
                show::updated(context, &library, update, written, revision, begun.elapsed());
            }
        }
    }
}
