use clap::Args;

use pathbuild_workspace::Inputs;

use super::InputArgs;
use crate::completion;

/// `pathbuild graph`, `deps`, `rdeps`, `where` and `why`. `--format` takes dot and mermaid here.
#[derive(Clone, Debug, Default, Args)]
pub struct GraphArgs {
    /// What is asked about.
    #[command(flatten)]
    pub inputs: InputArgs,
}

/// `pathbuild list` and `stats`.
#[derive(Clone, Debug, Default, Args)]
pub struct ListArgs {
    /// Patterns of path names (8*, 20[0-5]?.1P), drawings (.dxf), directories; without drawings or directories the library
    #[arg(value_name = "GLOB|DRAWING|DIRECTORY", add = completion::paths())]
    pub inputs: Vec<String>,
    /// Compare with programs written for this post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", add = completion::posts())]
    pub post: Option<String>,
}

impl ListArgs {
    /// What is asked about.
    pub fn inputs(&self) -> Inputs {
        Inputs { inputs: self.inputs.clone() }
    }
}
