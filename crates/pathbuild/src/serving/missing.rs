//! Replaces `watch --serve` in builds without the server.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::watch::Listener;

use crate::args::ServeArgs;
use crate::context::Context;

/// A server that cannot exist in this build.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Server {}

impl Server {
    /// Refuses `--serve`, because this build has no server.
    pub(crate) fn start(context: &Context, args: &ServeArgs) -> Result<Option<Self>, String> {
        let missing = context.choose(
            "--serve: this pathbuild was built without the feature `serve`",
            "--serve: dieses pathbuild wurde ohne das Feature `serve` gebaut",
        );
        match args.serve {
            Some(_) => Err(missing.to_owned()),
            None => Ok(None),
        }
    }

    pub(crate) fn page<'a>(&self, _: &'a Context) -> Box<dyn Listener + 'a> {
        match *self {}
    }

    pub(crate) fn halt(&self, _: &[Diagnostic], _: &str) {
        match *self {}
    }

    pub(crate) fn is_over(&self) -> bool {
        match *self {}
    }

    pub(crate) fn waits_for_fixes(&self) -> bool {
        match *self {}
    }
}
