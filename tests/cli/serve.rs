//! Tests `watch --serve`: authorization and answers.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
#[cfg(unix)]
use std::process::Command;
use std::process::{Child, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use pathbuild_testkit::sheet;
use serde_json::Value;

use crate::support::{Place, StderrLines, program};

const CONFIGURATION: &str =
    "feed = 150\nrapid = 1000\nsweep-height = 20\nlibrary = [\"library\"]\nsearch = [\"library\"]\n";

fn dxf(name: &str, thickness: u32) -> Vec<u8> {
    let text = format!("layer {name}\nstart 0,0 \"T{thickness} O2 I1 B0 MPlate\"\nmill 0,0 40,0\nend 40,0\n");
    sheet(&text).unwrap().to_dxf()
}

/// Returns the drawing of a path with an error: its start has no text.
fn wrong(name: &str) -> Vec<u8> {
    sheet(&format!("layer {name}\nstart 0,0\nmill 0,0 40,0\nend 40,0\n")).unwrap().to_dxf()
}

fn library() -> Place {
    Place::new()
        .file("pathbuild.toml", CONFIGURATION)
        .file("library/1001.dxf", dxf("1001.1P", 5))
        .file("library/1002.dxf", dxf("1002.1P", 4))
        .file("library/1003.dxf", wrong("1003.1P"))
}

/// A running server, which ends when this value is dropped.
struct Served<'a> {
    place: &'a Place,
    child: Child,
    lines: StderrLines,
    /// The output up to the end of the first check.
    said: Vec<String>,
    link: String,
    port: u16,
}

struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Answer {
    #[track_caller]
    fn json(&self) -> Value {
        assert_eq!(self.status, 200, "{}", self.head);
        serde_json::from_str(&self.body).unwrap()
    }
}

impl<'a> Served<'a> {
    fn begin(place: &'a Place, arguments: &str) -> Self {
        Self::begin_until(place, arguments, "watching ")
    }

    fn begin_until(place: &'a Place, arguments: &str, until: &str) -> Self {
        let mut command = program();
        command.args(arguments.split_whitespace()).arg("--no-cache").current_dir(place.path());
        let mut child = command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
        let lines = StderrLines::by(&mut child);
        let mut served = Self { place, child, lines, said: Vec::new(), link: String::new(), port: 0 };
        served.said = served.until(until);
        let at = served.said.iter().find_map(|line| line.strip_prefix("serving at ")).unwrap();
        served.link = at.to_owned();
        let port = at.split('/').nth(2).unwrap().rsplit(':').next().unwrap();
        served.port = port.parse().unwrap();
        served
    }

    /// Reads lines up to one that contains a text, and returns them.
    #[track_caller]
    fn until(&self, text: &str) -> Vec<String> {
        self.lines.until(text)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.place.path().join(name), bytes).unwrap();
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        stream
    }

    /// Sends raw lines; `PORT` is replaced by the server's port.
    fn send(&self, lines: &[&str]) -> Answer {
        self.send_with(lines, "")
    }

    fn send_with(&self, lines: &[&str], body: &str) -> Answer {
        let mut stream = self.connect();
        let request = format!("{}\r\nConnection: close\r\n\r\n{body}", lines.join("\r\n"));
        stream.write_all(request.replace("PORT", &self.port.to_string()).as_bytes()).unwrap();
        let mut text = String::new();
        stream.read_to_string(&mut text).unwrap();
        let (head, body) = text.split_once("\r\n\r\n").unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        Answer { status, head: head.to_ascii_lowercase(), body: body.to_owned() }
    }

    fn get(&self, what: &str) -> Answer {
        self.send(&[&format!("GET {what} HTTP/1.1"), "Host: localhost:PORT"])
    }

    fn status(&self, what: &str, headers: &[&str]) -> u16 {
        let first = format!("GET {what} HTTP/1.1");
        self.send(&[&[first.as_str()], headers].concat()).status
    }

    /// Opens the stream of revisions.
    fn events(&self) -> Events {
        let mut stream = self.connect();
        write!(stream, "GET /api/events HTTP/1.1\r\nHost: localhost:{}\r\n\r\n", self.port).unwrap();
        Events(BufReader::new(stream))
    }

    /// Interrupts the server like Ctrl+C.
    #[cfg(unix)]
    fn interrupt(&self) {
        let id = self.child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    }
}

struct Events(BufReader<TcpStream>);

impl Events {
    /// Waits for the next event.
    fn next(&mut self) -> (String, u64) {
        loop {
            let mut line = String::new();
            assert!(self.0.read_line(&mut line).unwrap() > 0, "the stream has ended");
            if let Some((run, revision)) =
                line.trim().strip_prefix("data: ").and_then(|it| it.split_once(' '))
            {
                return (run.to_owned(), revision.parse().unwrap());
            }
        }
    }

    /// Waits for the next event after a revision.
    fn after(&mut self, revision: u64) -> u64 {
        loop {
            let (_, next) = self.next();
            if next > revision {
                return next;
            }
        }
    }
}

impl Drop for Served<'_> {
    fn drop(&mut self) {
        _ = self.child.kill();
        _ = self.child.wait();
    }
}

/// Requests are only answered under names that cannot be redirected to this machine (DNS rebinding).
#[test]
fn only_own_names_are_answered() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    for path in ["/", "/page.js", "/api/library", "/api/scene?file=library/1001.dxf"] {
        for host in ["localhost:PORT", "LocalHost:PORT", "127.0.0.1:PORT", "[::1]:PORT"] {
            assert_eq!(served.status(path, &[&format!("Host: {host}")]), 200, "{path} {host}");
        }
        for host in [
            "evil.example:PORT",
            "localhost",
            "127.0.0.1",
            "localhost:PORT1",
            "localhost.:PORT",
            "localhost.evil.example:PORT",
            "127.0.0.2:PORT",
            "127.0.0.1@evil.example:PORT",
            "0.0.0.0:PORT",
            "",
        ] {
            assert_eq!(served.status(path, &[&format!("Host: {host}")]), 421, "{path} {host}");
        }
        assert_eq!(served.status(path, &["Host: localhost:PORT", "Host: localhost:PORT"]), 421);
        assert_eq!(served.status(path, &["Host: localhost:PORT", "Host: evil.example:PORT"]), 421);
    }
    assert!(matches!(served.status("/", &[]), 400 | 421));
    let absolute =
        |authority: &str| served.status(&format!("http://{authority}/"), &["Host: localhost:PORT"]);
    assert_eq!(absolute("localhost:PORT"), 200);
    assert_eq!(absolute("evil.example:PORT"), 421);
}

#[test]
fn only_own_pages_are_answered() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let status =
        |origin: &str| served.status("/api/library", &["Host: localhost:PORT", &format!("Origin: {origin}")]);
    for origin in ["http://localhost:PORT", "http://127.0.0.1:PORT", "http://[::1]:PORT"] {
        assert_eq!(status(origin), 200, "{origin}");
    }
    for origin in [
        "null",
        "https://localhost:PORT",
        "http://localhost",
        "http://localhost:PORT.evil.example",
        "http://evil.example:PORT",
        "http://evil.example",
        "",
    ] {
        assert_eq!(status(origin), 403, "{origin}");
    }
    let two = ["Host: localhost:PORT", "Origin: http://localhost:PORT", "Origin: http://evil.example"];
    assert_eq!(served.status("/api/library", &two), 403);
}

#[test]
fn only_get_is_answered() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    for path in ["/", "/api/library", "/api/events", "/nothing"] {
        for method in ["HEAD", "POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "get"] {
            let first = format!("{method} {path} HTTP/1.1");
            let answer = served.send(&[&first, "Host: localhost:PORT", "Content-Length: 0"]);
            assert_eq!(answer.status, 405, "{first}: {}", answer.head);
            assert!(answer.head.contains("\r\nallow: get"), "{}", answer.head);
        }
    }
    assert_eq!(served.get("/nothing").status, 404);
}

/// A page posts the text of a program. The server stores nothing of it.
#[test]
fn a_program_is_taken_from_own_pages() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let text = "(TOOL/MILL, 6, 0, 20, 0)\nG21 G90 G94 G17\nG0 Z5\nG0 X0 Y0\nG1 Z-2 F100\nG1 X20\nG0 X40\nG1 X60\nG0 Z5\nM30\n";
    let send = |method: &str, origin: &str| {
        let first = format!("{method} /api/program?name=a.nc&surface=0 HTTP/1.1");
        let length = format!("Content-Length: {}", text.len());
        served.send_with(&[&first, "Host: localhost:PORT", &format!("Origin: {origin}"), &length], text)
    };
    let answer = send("POST", "http://localhost:PORT");
    assert_eq!(answer.status, 200, "{}", answer.body);
    let scene = answer.json();
    assert_eq!(scene["findings"][0]["code"], "PB740");
    assert_eq!(scene["findings"][0]["line"], 7);
    assert_eq!(scene["program"]["cutters"][0]["diameter"], 6.0);
    assert_eq!(scene["program"]["checks"][0]["outcome"], "assumed");
    assert_eq!(send("POST", "http://evil.example").status, 403);
    let wrong = send("GET", "http://localhost:PORT");
    assert_eq!(wrong.status, 405);
    assert!(wrong.head.contains("\r\nallow: post"), "{}", wrong.head);
}

/// A server that is reachable from elsewhere requires a token, which is in the fragment of the link.
#[test]
fn from_elsewhere_a_token_is_needed() {
    let place = library();
    let served = Served::begin(&place, "watch -v --serve 0.0.0.0:0");
    let (address, token) = served.link.split_once("/#token=").unwrap();
    assert_eq!(token.len(), 32);
    let host = format!("Host: {}", address.strip_prefix("http://").unwrap());
    let with = |authorization: &str| {
        served.status("/api/library", &[&host, &format!("Authorization: {authorization}")])
    };
    assert_eq!(with(&format!("Bearer {token}")), 200);
    let other = token.replace(|digit: char| digit == token.chars().next().unwrap(), "g");
    for wrong in [
        "",
        "Bearer",
        "Bearer ",
        token,
        &format!("Bearer {}", &token[..31]),
        &format!("Bearer {token}0"),
        &format!("Bearer {other}"),
        &format!("Basic {token}"),
    ] {
        assert_eq!(with(wrong), 401, "{wrong}");
    }
    for path in ["/api/library", "/api/scene?file=library/1001.dxf", "/api/events", "/api/nothing"] {
        assert_eq!(served.status(path, &[&host]), 401, "{path}");
        assert_eq!(served.status(&format!("{path}?token={token}"), &[&host]), 401, "{path}");
    }
    // The page itself contains nothing about drawings.
    let page = served.send(&["GET / HTTP/1.1", &host]);
    assert_eq!(page.status, 200);
    assert!(!page.body.contains(token) && !page.head.contains(token));
    // Requests to IP addresses are answered, but those to names are not, because others control how names are resolved.
    let right = format!("Authorization: Bearer {token}");
    assert_eq!(served.status("/api/library", &["Host: 10.1.2.3:PORT", &right]), 200);
    assert_eq!(served.status("/api/library", &["Host: [fe80::1]:PORT", &right]), 200);
    for host in ["evil.example:PORT", "10.1.2.3.example:PORT", "10.1.2.3:1", "10.1.2:PORT"] {
        assert_eq!(served.status("/api/library", &[&format!("Host: {host}"), &right]), 421, "{host}");
    }
    served.write("library/1001.dxf", dxf("1001.1P", 3));
    let said = [&served.said[..], &served.until("1001.dxf: changed")].concat();
    assert_eq!(said.iter().filter(|line| line.contains(token)).count(), 1, "{said:#?}");
}

#[test]
fn on_this_machine_none_is_needed() {
    let place = library();
    let served = Served::begin(&place, "watch --serve=localhost:0");
    assert_eq!(served.link, format!("http://localhost:{}/", served.port));
    served.get("/api/library").json();
}

#[test]
fn answers_forbid_whatever_a_page_does_not_need() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    for path in ["/", "/page.js", "/page.css", "/api/library", "/nothing"] {
        let head = served.get(path).head;
        assert!(head.contains("content-security-policy: default-src 'none'; script-src 'self'; "), "{head}");
        assert!(!head.contains("unsafe") && !head.contains("access-control"), "{head}");
        assert!(head.contains("x-content-type-options: nosniff"), "{head}");
        assert!(head.contains("cross-origin-resource-policy: same-origin"), "{head}");
        assert!(head.contains("cache-control: no-store"), "{head}");
    }
    let page = served.get("/");
    assert!(page.head.contains("content-type: text/html"), "{}", page.head);
    assert!(!page.body.contains("http:") && !page.body.contains("<style"), "{}", page.body);
}

/// The rows are the same as in `list`, the statistics as in `stats`, and the pictures as in `view`.
#[test]
fn what_is_shown_is_what_commands_print() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let library = served.get("/api/library").json();
    assert_eq!(library["complete"], true);
    assert_eq!(library["halted"], Value::Null);
    let printed = |command: &str| -> Vec<Value> {
        let run = place.run(&format!("{command} --format json --no-cache"));
        let objects = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        let rows = objects.filter(|row| matches!(row["type"].as_str(), Some("path" | "statistics")));
        rows.map(|mut row| {
            row.as_object_mut().unwrap().remove("type");
            row
        })
        .collect()
    };
    let drawings = library["drawings"].as_array().unwrap();
    let rows: Vec<Value> = drawings.iter().flat_map(|it| it["rows"].as_array().unwrap().clone()).collect();
    assert_eq!(rows.len(), 3);
    assert_eq!(rows, printed("list"));
    assert_eq!(library["statistics"], printed("stats")[0]);
    for path in ["1001.1P", "1003.1P"] {
        place.run(&format!("view {path} -o seen.json --no-cache"));
        let drawing = format!("library/{}.dxf", &path[..4]);
        let scene = served.get(&format!("/api/scene?file={drawing}&path={path}")).body;
        assert_eq!(scene, place.read("seen.json").trim_end(), "{path}");
    }
    let wrong: Value = served.get("/api/scene?file=library/1003.dxf&path=1003.1P").json();
    assert!(!wrong["findings"].as_array().unwrap().is_empty());
    assert!(!wrong["paths"][0]["elements"].as_array().unwrap().is_empty());
    let picture = served.get("/api/picture?file=library%2F1001.dxf&path=1001.1P");
    assert!(picture.head.contains("content-type: image/svg+xml") && picture.body.starts_with("<svg"));
}

/// The most hostile name that the file system allows.
const HOSTILE: &str = if cfg!(windows) { "a&b 'i'.dxf" } else { "a&b \"<i>.dxf" };

/// Drawings that are not listed are inaccessible, whatever their names.
#[test]
fn only_listed_drawings_are_read() {
    let place = library()
        .file("secret.dxf", dxf("9001.1P", 5))
        .file(&format!("library/{HOSTILE}"), dxf("1004.1P", 5));
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    for file in [
        "secret.dxf",
        "library/../secret.dxf",
        "library%2F..%2Fsecret.dxf",
        "./library/1001.dxf",
        "/etc/passwd",
        "pathbuild.toml",
        "library",
        "",
        "%00",
        "library/1001.dxf%00",
    ] {
        assert_eq!(served.get(&format!("/api/scene?file={file}")).status, 404, "{file}");
        assert_eq!(served.get(&format!("/api/picture?file={file}")).status, 404, "{file}");
    }
    assert_eq!(served.get("/api/scene?file=library/1001.dxf&path=1001.1P").status, 200);
    assert_eq!(served.get("/api/scene?file=library/1001.dxf&path=1002.1P").status, 404);
    assert_eq!(served.get("/api/scene").status, 400);
    assert_eq!(served.get("/api/library?since=-1").status, 400);
    for path in ["/..%2fpathbuild.toml", "/../pathbuild.toml", "/library/1001.dxf", "/api/"] {
        assert_eq!(served.get(path).status, 404, "{path}");
    }
    let drawings = served.get("/api/library").json()["drawings"].clone();
    let names: Vec<&str> = drawings.as_array().unwrap().iter().filter_map(|it| it["file"].as_str()).collect();
    assert!(names.contains(&&*format!("library/{HOSTILE}")), "{names:?}");
    let asked = HOSTILE
        .replace('&', "%26")
        .replace(' ', "+")
        .replace('"', "%22")
        .replace('<', "%3C")
        .replace('>', "%3E");
    assert_eq!(served.get(&format!("/api/scene?file=library/{asked}")).status, 200);
}

#[test]
fn saved_drawings_are_told() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let mut events = served.events();
    let (run, first) = events.next();
    assert_eq!(run.len(), 32);
    let changed = |since: u64| {
        let library = served.get(&format!("/api/library?since={since}")).json();
        assert_eq!(library["all"], false);
        library["drawings"].clone()
    };
    assert_eq!(changed(first), Value::Array(Vec::new()));
    served.write("library/1003.dxf", dxf("1003.1P", 5));
    let second = events.after(first);
    let drawings = changed(first);
    assert_eq!(drawings.as_array().unwrap().len(), 1, "{drawings}");
    assert_eq!(drawings[0]["rows"][0]["state"], "ok", "{drawings}");
    // The other rows did not change.
    fs::remove_file(place.path().join("library/1002.dxf")).unwrap();
    events.after(second);
    served.until("1002.dxf: removed");
    let drawings = changed(second);
    assert_eq!(drawings[0]["file"], "library/1002.dxf");
    assert_eq!(drawings[0]["rows"], Value::Null);
    assert_eq!(served.get("/api/library").json()["statistics"]["paths"], 2);
    assert_eq!(served.get("/api/scene?file=library/1002.dxf").status, 404);
    // A page of another run, or one that was suspended, gets all rows.
    assert_eq!(served.get("/api/library?since=1000000").json()["all"], true);
}

/// Names are available before anything is checked.
#[test]
fn names_come_first_and_states_follow() {
    // A long path, and a single thread, give the first questions time to arrive before everything is checked, on a busy machine too.
    const SEGMENTS: usize = 10_000;
    let corner = |index: usize| format!("{},{}", index, index % 2);
    let corners: Vec<String> = (0..=SEGMENTS).map(corner).collect();
    let long = format!(
        "layer 2000.1P\nstart 0,0 \"T5 O2 I1 B0 MPlate\"\nmill {}\nend {}\n",
        corners.join(" "),
        corner(SEGMENTS)
    );
    let place = library().file("library/2000.1P.dxf", sheet(&long).unwrap().to_dxf());
    let served = Served::begin_until(&place, "watch --jobs 1 --serve 127.0.0.1:0", "serving at ");
    let mut was_unchecked = false;
    loop {
        let library = served.get("/api/library").json();
        let drawings = library["drawings"].as_array().unwrap();
        assert!(drawings.is_empty() || drawings.len() == 4, "{}", drawings.len());
        let states: Vec<&Value> = drawings.iter().map(|drawing| &drawing["rows"][0]["state"]).collect();
        assert!(drawings.iter().all(|drawing| drawing["rows"][0]["path"].is_string()));
        was_unchecked |= states.len() == 4 && states.iter().all(|state| state.is_null());
        if library["complete"] == true {
            assert!(!states.iter().any(|state| state.is_null()));
            break;
        }
    }
    assert!(was_unchecked);
}

/// A large library is displayed before it is complete.
#[test]
fn a_page_gets_as_many_drawings_as_it_asks_for() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let asked = |query: &str| {
        let library = served.get(&format!("/api/library{query}")).json();
        let drawings = library["drawings"].as_array().unwrap();
        let files: Vec<String> = drawings.iter().map(|it| it["file"].as_str().unwrap().to_owned()).collect();
        (files, library["more"].as_bool().unwrap())
    };
    let (all, more) = asked("");
    assert_eq!((all.len(), more), (3, false));
    assert_eq!(asked("?since=0&most=2"), (all[..2].to_vec(), true));
    assert_eq!(asked("?since=0&most=3"), (all, false));
    assert_eq!(served.get("/api/library?most=-1").status, 400);
}

/// A client that keeps connections open cannot lock out others permanently.
#[test]
fn so_many_connections_are_answered_at_a_time() {
    const MOST: usize = 256;
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let mut open: Vec<Events> = (0..MOST - 1).map(|_| served.events()).collect();
    for events in &mut open {
        events.next();
    }
    // This is the last connection that is answered.
    assert_eq!(served.get("/api/library").status, 200);
    let mut last = served.events();
    last.next();
    // A further connection has to wait until another one ends.
    let Events(mut waiting) = served.events();
    waiting.get_ref().set_read_timeout(Some(Duration::from_secs(2))).unwrap();
    assert!(waiting.fill_buf().is_err(), "it is answered");
    open.pop();
    waiting.get_ref().set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    Events(waiting).next();
}

/// Idle connections are closed, but slow answers are not.
#[test]
fn connections_that_say_nothing_are_closed() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let begun = Instant::now();
    let mut events = served.events();
    let (_, first) = events.next();
    let half = format!("GET /api/library HTTP/1.1\r\nHost: localhost:{}\r\n", served.port);
    let (mut silent, mut late) = ([served.connect(), served.connect()], served.connect());
    silent[1].write_all(half.as_bytes()).unwrap();
    std::thread::sleep(Duration::from_secs(7));
    // This request arrives in time and is answered, but then its connection is closed like the others.
    write!(late, "{half}\r\n").unwrap();
    let mut answered = BufReader::new(late);
    assert!(answered.fill_buf().unwrap().starts_with(b"HTTP/1.1 200"));
    for stream in &mut silent {
        let mut said = String::new();
        stream.read_to_string(&mut said).unwrap();
        assert!(!said.contains("200 OK"), "{said}");
    }
    assert!(begun.elapsed().as_secs() >= 10, "{:?}", begun.elapsed());
    answered.read_to_end(&mut Vec::new()).unwrap();
    assert!(begun.elapsed().as_secs() >= 17, "{:?}", begun.elapsed());
    served.write("library/1001.dxf", dxf("1001.1P", 3));
    events.after(first);
}

/// Programs that `--emit` has written are shown as current, even if a post wrote them.
#[test]
fn with_emit_the_state_is_that_after_writing() {
    for post in ["", "post = \"linuxcnc\"\nspindle = \"manual\"\n"] {
        let emits = format!("{post}{CONFIGURATION}\n[emit]\ntargets = [\"1001*\"]\n");
        let place = library().file("pathbuild.toml", emits);
        let served = Served::begin(&place, "watch --emit --serve 127.0.0.1:0");
        let state = || served.get("/api/library").json()["drawings"][0]["rows"][0]["state"].clone();
        assert_eq!(state(), "current", "{post}");
        served.write("library/1001.dxf", dxf("1001.1P", 6));
        served.until("1001.dxf: changed");
        assert_eq!(state(), "current", "{post}");
    }
}

#[test]
fn a_wrong_configuration_is_shown_until_it_is_put_right() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    served.write("pathbuild.toml", "feed = \n");
    served.until("until this is fixed");
    let library = served.get("/api/library").json();
    assert_eq!(library["halted"], "");
    assert!(!library["problems"].as_array().unwrap().is_empty());
    assert_eq!(served.get("/api/scene?file=library/1001.dxf").status, 503);
    served.write("pathbuild.toml", CONFIGURATION);
    served.until("watching ");
    let library = served.get("/api/library?since=1").json();
    assert_eq!((&library["halted"], &library["all"]), (&Value::Null, &Value::Bool(true)));
    assert_eq!(served.get("/api/scene?file=library/1001.dxf").status, 200);
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_it_without_an_error() {
    let place = library();
    let mut served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let _open = served.events();
    served.interrupt();
    assert_eq!(served.child.wait().unwrap().code(), Some(0));
    // Ctrl+C also ends the run while nothing can be checked.
    let mut served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    served.write("pathbuild.toml", "feed = \n");
    served.until("until this is fixed");
    served.interrupt();
    assert_eq!(served.child.wait().unwrap().code(), Some(0));
}

#[test]
fn it_ends_once_the_page_is_closed_if_that_is_wanted() {
    let place = library();
    let mut served = Served::begin(&place, "watch --serve 127.0.0.1:0 --until-closed");
    let mut events = served.events();
    events.next();
    drop(events);
    // The page is loaded again.
    let mut events = served.events();
    events.next();
    std::thread::sleep(Duration::from_secs(6));
    assert_eq!(served.child.try_wait().unwrap(), None);
    drop(events);
    assert_eq!(served.child.wait().unwrap().code(), Some(0));
}

/// The output of a run with `--until-closed` is invisible, so the page shows the problem.
#[test]
fn until_closed_even_a_wrong_beginning_is_shown() {
    let place = library().file("pathbuild.toml", "feed = \n");
    let served =
        Served::begin_until(&place, "watch --serve 127.0.0.1:0 --until-closed", "until this is fixed");
    assert!(!served.get("/api/library").json()["problems"].as_array().unwrap().is_empty());
    let place = library();
    fs::remove_file(place.path().join("pathbuild.toml")).unwrap();
    let served = Served::begin(&place, "watch library --serve 127.0.0.1:0 --until-closed");
    assert_eq!(served.get("/api/library").json()["drawings"].as_array().unwrap().len(), 3);
}

#[test]
fn a_port_that_is_taken_is_told() {
    let place = library();
    let taken = TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let port = taken.local_addr().unwrap().port();
    let run = place.run(&format!("watch --serve 127.0.0.1:{port}"));
    assert_eq!(run.status, Some(2), "{run}");
    assert!(run.stderr.contains("--serve: "), "{run}");
    // Without an explicit port, another one is taken if the default is in use.
    let _usual = TcpListener::bind(("127.0.0.1", 8347));
    let served = Served::begin(&place, "watch --serve");
    assert!(served.said.iter().any(|line| line == "port 8347 is taken"), "{:?}", served.said);
    served.get("/api/library").json();
}

#[test]
fn what_is_no_address_is_wrong_usage() {
    let place = library();
    for address in ["library", "1001.1P", "library/1001.dxf", "65536", "localhost:x", "a b:80", ":80", "[::1"]
    {
        let run = place.run_with(&["watch", "--serve", address]);
        assert_eq!(run.status, Some(2), "{run}");
        assert!(run.stderr.contains("an address is PORT"), "{run}");
    }
    let run = place.run("watch --open");
    assert_eq!(run.status, Some(2), "{run}");
    assert!(run.stderr.contains("--serve"), "{run}");
}

/// A simulated browser that records the addresses it opens.
#[cfg(target_os = "linux")]
struct Browser(tempfile::TempDir);

#[cfg(target_os = "linux")]
impl Browser {
    fn new() -> Self {
        use std::os::unix::fs::PermissionsExt;

        let directory = tempfile::TempDir::new().unwrap();
        let program = directory.path().join("xdg-open");
        fs::write(
            &program,
            format!(
                "#!/bin/sh\necho \"$1\" > {0}/new && mv {0}/new {0}/opened\n",
                directory.path().display()
            ),
        )
        .unwrap();
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
        Self(directory)
    }

    /// Runs `pathbuild-open` with dropped files.
    fn open(&self, directory: &std::path::Path, dropped: &[&str]) -> Child {
        self.start(env!("CARGO_BIN_EXE_pathbuild-open").as_ref(), directory, dropped)
    }

    fn start(&self, program: &std::path::Path, directory: &std::path::Path, dropped: &[&str]) -> Child {
        let mut command = Command::new(program);
        command.env_clear().env("PATH", format!("{}:/usr/bin:/bin", self.0.path().display()));
        command.args(dropped).current_dir(directory);
        command.stdin(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    }

    /// Returns the address that the browser was told to open.
    fn opened(&self) -> String {
        for _ in 0..200 {
            if let Ok(opened) = fs::read_to_string(self.0.path().join("opened")) {
                return opened.trim().to_owned();
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        panic!("nothing was opened");
    }
}

#[cfg(target_os = "linux")]
fn extension(file: &str) -> &str {
    file.rsplit('.').next().unwrap()
}

/// Returns the drawings that a page lists when everything is checked; then closes the page.
#[cfg(target_os = "linux")]
fn listed_and_closed(address: &str) -> Vec<String> {
    let authority = address.strip_prefix("http://").unwrap().trim_end_matches('/');
    let mut events = TcpStream::connect(authority).unwrap();
    write!(events, "GET /api/events HTTP/1.1\r\nHost: {authority}\r\n\r\n").unwrap();
    loop {
        let mut stream = TcpStream::connect(authority).unwrap();
        write!(stream, "GET /api/library HTTP/1.1\r\nHost: {authority}\r\nConnection: close\r\n\r\n")
            .unwrap();
        let mut text = String::new();
        stream.read_to_string(&mut text).unwrap();
        let library: Value = serde_json::from_str(text.split_once("\r\n\r\n").unwrap().1).unwrap();
        if library["complete"] == true {
            let drawings = library["drawings"].as_array().unwrap().iter();
            return drawings.map(|drawing| drawing["file"].as_str().unwrap().to_owned()).collect();
        }
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn what_is_dropped_on_pathbuild_open_is_shown_until_it_is_closed() {
    let place = library().file("other/1009.dxf", dxf("1009.1P", 5));
    let whole = &["library/1001.dxf", "library/1002.dxf", "library/1003.dxf"][..];
    let cases: [(&str, &[&str], &[&str]); 4] = [
        ("library", &["1001.dxf"], &["library/1001.dxf"]),
        (".", &["other"], &["other/1009.dxf"]),
        ("other", &[".."], whole),
        (".", &["library/1002.dxf", "other"], &["library/1002.dxf", "other/1009.dxf"]),
    ];
    let run = |(directory, dropped, expected): &(&str, &[&str], &[&str])| {
        let browser = Browser::new();
        let mut child = browser.open(&place.path().join(directory), dropped);
        assert_eq!(listed_and_closed(&browser.opened()), *expected, "{dropped:?}");
        assert_eq!(child.wait().unwrap().code(), Some(0), "{dropped:?}");
    };
    // Each case waits for its page to be opened again, so all run at the same time.
    std::thread::scope(|scope| cases.iter().for_each(|case| _ = scope.spawn(move || run(case))));
}

#[cfg(target_os = "linux")]
#[test]
fn pathbuild_open_shows_programs_and_what_went_wrong() {
    let place = library().file("a.gcode", "%\nG21 G90 G94 G17\nG00 Z5\nG01 Z-1 F50\nM30\n%\n");
    let browser = Browser::new();
    let mut child = browser.open(place.path(), &["a.gcode"]);
    assert_eq!(extension(&browser.opened()), "html");
    child.wait().unwrap();
    // Without the program beside it, `pathbuild-open` can do nothing, and reports that.
    let browser = Browser::new();
    let alone = place.path().join("alone");
    fs::copy(env!("CARGO_BIN_EXE_pathbuild-open"), &alone).unwrap();
    let mut child = browser.start(&alone, place.path(), &[]);
    let opened = browser.opened();
    assert_eq!(extension(&opened), "txt");
    assert!(fs::read_to_string(&opened).unwrap().contains("needs the program pathbuild"));
    assert_eq!(child.wait().unwrap().code(), Some(1));
    fs::remove_file(opened).unwrap();
}

/// All drawings below the directory are shown, as by `list`.
#[test]
fn without_a_library_all_that_lies_there_is_shown() {
    let place = library();
    fs::remove_file(place.path().join("pathbuild.toml")).unwrap();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    assert_eq!(served.get("/api/library").json()["drawings"].as_array().unwrap().len(), 3);
    served.write("1010.dxf", dxf("1010.1P", 5));
    served.until("1010.dxf: changed");
}

/// Results under a configuration that was removed are not current.
#[test]
fn a_page_says_that_the_configuration_is_gone() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let file = place.path().join("pathbuild.toml");
    fs::remove_file(&file).unwrap();
    served.until("until this is fixed");
    assert_eq!(served.get("/api/library").json()["halted"], "pathbuild.toml is missing");
    served.write("pathbuild.toml", CONFIGURATION);
    served.until("watching ");
    assert_eq!(served.get("/api/library").json()["halted"], Value::Null);

    fs::remove_file(&file).unwrap();
    fs::create_dir(&file).unwrap();
    served.until("until this is fixed");
    assert_ne!(served.get("/api/library").json()["halted"], Value::Null);
}

/// A client that keeps requesting pictures does not delay the detection of edits.
#[test]
fn requests_without_end_hold_up_no_change() {
    let place = library();
    let served = Served::begin(&place, "watch --serve 127.0.0.1:0");
    let (port, is_over) = (served.port, AtomicBool::new(false));
    let look = || {
        let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        let what = "/api/picture?file=library/1001.dxf&path=1001.1P";
        write!(stream, "GET {what} HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: close\r\n\r\n").unwrap();
        stream.read_to_end(&mut Vec::new()).unwrap();
    };
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                while !is_over.load(Ordering::Relaxed) {
                    look();
                }
            });
        }
        std::thread::sleep(Duration::from_millis(500));
        let begun = Instant::now();
        served.write("library/1002.dxf", dxf("1002.1P", 3));
        served.until("1002.dxf: changed");
        is_over.store(true, Ordering::Relaxed);
        assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
    });
}
