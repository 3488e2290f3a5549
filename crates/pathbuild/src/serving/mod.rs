//! `watch --serve`: the library as a live page. (book: program/live)
//!
//! The watching thread owns the session. It publishes the list of paths and answers questions through a [`Hub`]. The server runs in its
//! own thread and knows only the hub. Every change has a number. Pages are notified of new numbers by events, and request all changes
//! since the last one that they know.

mod endpoint;
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

use endpoint::Endpoint;
use hub::Hub;
use page::Page;
use routes::Routes;

/// A running server. It outlives changes of the configuration.
pub(crate) struct Server {
    hub: Arc<Hub>,
    waits_for_fixes: bool,
}

impl Server {
    /// Starts the server if the arguments request it.
    ///
    /// # Errors
    /// The reason why the server cannot be started.
    pub(crate) fn start(context: &Context, args: &ServeArgs) -> Result<Option<Self>, String> {
        let Some(address) = &args.serve else { return Ok(None) };
        let (listener, endpoint) = Endpoint::open(address).map_err(|reason| format!("--serve: {reason}"))?;
        print_address(context, address, &endpoint);
        let link = endpoint.link();
        let hub = Arc::new(Hub::default());
        let routes = Routes::new(endpoint, Arc::clone(&hub), context.lang())?;
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
        Ok(Some(Self { hub, waits_for_fixes: args.until_closed }))
    }

    /// Returns the listener that updates the page while one configuration is in force.
    pub(crate) fn page<'a>(&self, context: &'a Context) -> Box<dyn Listener + 'a> {
        Box::new(Page::new(context, Arc::clone(&self.hub)))
    }

    /// Shows on the page the reason why nothing is checked.
    pub(crate) fn halt(&self, problems: &[Diagnostic], reason: &str) {
        self.hub.halt(problems, reason);
    }

    /// Whether the user has requested the end of watching.
    pub(crate) fn is_over(&self) -> bool {
        self.hub.is_over()
    }

    /// Whether to wait for fixes if the configuration is invalid at the beginning, because the user only sees the page.
    pub(crate) fn waits_for_fixes(&self) -> bool {
        self.waits_for_fixes
    }
}

/// Prints the address of the page. The line may contain the token, so it must not be logged.
fn print_address(context: &Context, address: &Address, endpoint: &Endpoint) {
    if address.port.is_none() && endpoint.port() != endpoint::DEFAULT_PORT {
        context.printer.status(match context.lang() {
            Lang::En => format!("port {} is taken", endpoint::DEFAULT_PORT),
            Lang::De => format!("Port {} ist belegt", endpoint::DEFAULT_PORT),
        });
    }
    let phrase = context.choose("serving at", "zu sehen unter");
    context.printer.status(format_args!("{phrase} {}", endpoint.link()));
}

/// Runs the server in a thread that ends with the program.
fn serve(listener: TcpListener, routes: Routes, until_closed: bool) -> Result<(), String> {
    let work = move || routes.run(listener, until_closed);
    thread::Builder::new().name("server".to_owned()).spawn(work).map_err(|error| error.to_string())?;
    Ok(())
}
