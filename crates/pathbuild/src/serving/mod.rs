//! `watch --serve`: the library as a page that is live. (book: program/live)
//!
//! The thread that watches has the one session. It publishes what there is to list, and answers what it is asked, in a [`Hub`]; the server
//! works in a thread of its own and knows nothing but that. What is published has a number: a page hears of a new one by an event, and asks
//! for all that came after the one that it has.

mod connections;
mod door;
mod guard;
mod hub;
mod page;
mod routes;

use std::net::TcpListener;
use std::sync::Arc;
use std::thread;

use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_workspace::watch::Listener;

use crate::args::{Address, ServeArgs};
use crate::context::Context;

use door::Door;
use hub::Hub;
use page::Page;
use routes::Routes;

/// A page that is served, from configuration to configuration.
pub(crate) struct Server {
    hub: Arc<Hub>,
    waits: bool,
}

impl Server {
    /// Serves what the arguments ask for, if anything.
    ///
    /// # Errors
    /// Why that cannot be.
    pub(crate) fn start(context: &Context, args: &ServeArgs) -> Result<Option<Self>, String> {
        let Some(address) = &args.serve else { return Ok(None) };
        let (listener, door) = Door::open(address).map_err(|reason| format!("--serve: {reason}"))?;
        tell(context, address, &door);
        let link = door.link();
        let hub = Arc::new(Hub::default());
        let routes = Routes::new(door, Arc::clone(&hub), context.lang())?;
        serve(listener, routes, args.until_closed)?;
        if args.open
            && let Err(error) = open::that_detached(link)
        {
            let advice = context.choose(
                "no browser could be started: open the address named above",
                "kein Browser ließ sich starten: die oben genannte Adresse öffnen",
            );
            context.printer.status(format_args!("{advice} ({error})"));
        }
        Ok(Some(Self { hub, waits: args.until_closed }))
    }

    /// What the thread that watches tells and answers, under one configuration.
    pub(crate) fn page<'a>(&self, context: &'a Context) -> Box<dyn Listener + 'a> {
        Box::new(Page::new(context, Arc::clone(&self.hub)))
    }

    /// Shows why nothing is checked.
    pub(crate) fn halt(&self, problems: &[Diagnostic], reason: &str) {
        self.hub.halt(problems, reason);
    }

    /// Whether somebody ended it.
    pub(crate) fn is_over(&self) -> bool {
        self.hub.is_over()
    }

    /// Whether what is wrong at the beginning is waited for too: nobody sees it but on the page.
    pub(crate) fn waits(&self) -> bool {
        self.waits
    }
}

/// Where the page is. With a token in it the line is for people alone: what keeps standard error keeps the token.
fn tell(context: &Context, address: &Address, door: &Door) {
    if address.port.is_none() && door.port() != door::PORT {
        context.printer.status(match context.lang() {
            Lang::En => format!("port {} is taken", door::PORT),
            Lang::De => format!("Port {} ist belegt", door::PORT),
        });
    }
    let phrase = context.choose("served at", "zu sehen unter");
    context.printer.status(format_args!("{phrase} {}", door.link()));
}

/// Serves in a thread of its own, which ends with the program.
fn serve(listener: TcpListener, routes: Routes, until_closed: bool) -> Result<(), String> {
    let work = move || routes.run(listener, until_closed);
    thread::Builder::new().name("server".to_owned()).spawn(work).map_err(|error| error.to_string())?;
    Ok(())
}
