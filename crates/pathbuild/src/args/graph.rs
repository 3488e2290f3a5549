use clap::Args;

use super::InputArgs;

/// `pathbuild graph`, `deps`, `rdeps`, `where` and `why`. `--format` takes dot and mermaid here.
#[derive(Clone, Debug, Default, Args)]
pub struct GraphArgs {
    /// What is asked about.
    #[command(flatten)]
    pub inputs: InputArgs,
}
