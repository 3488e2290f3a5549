//! The options of `check` and `verify` for accepted findings, and the report that a baseline was written. (book: howto/ci)

use camino::Utf8Path;
use pathbuild_api::{BaselineOptions, WrittenBaseline};

use crate::args::WaiverArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::text::counted;

pub(crate) fn options(args: &WaiverArgs) -> BaselineOptions {
    let options = args.baseline.iter().fold(BaselineOptions::new(), BaselineOptions::file);
    match (args.update_baseline, args.accept) {
        (true, _) => options.update(),
        (false, Some(code)) => {
            let until = args.until.map(|date| date.to_string());
            let reason = args.reason.as_deref().unwrap_or_default();
            options.accept(code.to_string(), reason, until.as_deref())
        }
        (false, None) => options,
    }
}

/// Reports that the baseline was written instead of reporting the findings.
pub(crate) fn report_written(context: &Context, args: &WaiverArgs, written: &WrittenBaseline) -> ExitStatus {
    let noun = if args.update_baseline {
        [["known finding", "known findings"], ["bekannter Befund", "bekannte Befunde"]]
    } else {
        [["finding accepted", "findings accepted"], ["Befund hingenommen", "Befunde hingenommen"]]
    };
    let file = Utf8Path::new(&written.file).file_name().unwrap_or_default();
    context.printer.status(format_args!("{file}: {}", counted(written.findings, noun, context.lang())));
    ExitStatus::Success
}
