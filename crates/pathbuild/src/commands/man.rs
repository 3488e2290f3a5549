//! `pathbuild man`: prints the manual as roff, with all commands on one page.

use std::io;

use clap::Command;
use clap_mangen::Man;
use pathbuild_diagnostic::Lang;

use crate::context::Context;
use crate::exit::ExitStatus;
use crate::german;

/// Prints the manual page, for example for `pathbuild man | man -l -`.
pub fn run(context: &Context) -> ExitStatus {
    let mut page = Vec::new();
    // Writing to memory cannot fail.
    _ = write(&german::command(context.lang()), &mut page);
    let page = String::from_utf8_lossy(&page).into_owned();
    let page = if context.lang() == Lang::De { with_german_headings(page) } else { page };
    context.printer.result_bytes(page.as_bytes());
    ExitStatus::Success
}

fn write(command: &Command, page: &mut Vec<u8>) -> io::Result<()> {
    let man = Man::new(command.clone()).date("").source(format!("pathbuild {}", env!("CARGO_PKG_VERSION")));
    man.render_title(page)?;
    man.render_name_section(page)?;
    man.render_synopsis_section(page)?;
    man.render_description_section(page)?;
    man.render_options_section(page)?;
    write_subcommands(command, "", page)?;
    man.render_extra_section(page)
}

fn with_german_headings(page: String) -> String {
    let headings = [
        ("SYNOPSIS", "ÜBERSICHT"),
        ("DESCRIPTION", "BESCHREIBUNG"),
        ("OPTIONS", "OPTIONEN"),
        ("ARGUMENTS", "ARGUMENTE"),
        ("\"COMMON OPTIONS\"", "\"ALLGEMEINE OPTIONEN\""),
        ("EXTRA", "AUSSERDEM"),
    ];
    headings.into_iter().fold(page, |page, (en, de)| {
        page.replace(&format!(".SH {en}\n"), &format!(".SH {de}\n"))
            .replace(&format!(".SS {en}\n"), &format!(".SS {de}\n"))
    })
}

fn write_subcommands(command: &Command, prefix: &str, page: &mut Vec<u8>) -> io::Result<()> {
    for subcommand in
        command.get_subcommands().filter(|command| !command.is_hide_set() && command.get_name() != "help")
    {
        let name = format!("{prefix}{}", subcommand.get_name());
        write_subcommand(subcommand, &name, page)?;
        write_subcommands(subcommand, &format!("{name} "), page)?;
    }
    Ok(())
}

/// Writes the section of a command with its own options. Common options are listed once, for the program.
fn write_subcommand(command: &Command, name: &str, page: &mut Vec<u8>) -> io::Result<()> {
    let own = command.clone().mut_args(|arg| if arg.is_global_set() { arg.hide(true) } else { arg });
    let man = Man::new(own);
    let mut section = Vec::new();
    man.render_description_section(&mut section)?;
    man.render_synopsis_section(&mut section)?;
    man.render_options_section(&mut section)?;
    let text = String::from_utf8_lossy(&section);
    let heading = format!(".SH \"{}\"\n", name.to_uppercase());
    let text =
        text.replace(".SH DESCRIPTION\n", &heading).replace(".SH ", ".SS ").replacen(".SS \"", ".SH \"", 1);
    page.extend(text.bytes());
    Ok(())
}
