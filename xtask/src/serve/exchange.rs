//! Exchange of one request and its answer, over HTTP/1.1. The connection ends with the answer: on one machine
//! a new one costs nothing.

use std::{
    fs::File,
    io::{self, BufRead, BufReader, Read, Write},
    net::{Shutdown, TcpStream},
    path::Path,
    time::Duration,
};

use super::files::{file_meant, media_type, stored_form};

/// Longest request line with its headers, in bytes.
const LONGEST_HEAD: u64 = 32 * 1024;
/// Longest time that a browser may keep a connection open without asking for anything.
const PATIENCE: Duration = Duration::from_mins(1);

/// Answers the request on `connection` with a file of `dist` or with a refusal.
pub fn answer(mut connection: TcpStream, dist: &Path) -> io::Result<()> {
    connection.set_read_timeout(Some(PATIENCE))?;
    connection.set_nodelay(true)?;
    let head = read_head(&connection)?;
    match Request::read(&head) {
        None => refuse(&mut connection, "400 Bad Request", "")?,
        Some(request) if !matches!(request.method, "GET" | "HEAD") => {
            refuse(
                &mut connection,
                "405 Method Not Allowed",
                "Allow: GET, HEAD\r\n",
            )?;
        }
        Some(request) => match file_meant(request.address, dist) {
            None => refuse(&mut connection, "404 Not Found", "")?,
            Some(file) => send(&mut connection, &request, &file)?,
        },
    }
    // What the browser may still be sending is read away: closing before would tear down the
    // answer with the connection.
    connection.shutdown(Shutdown::Write)?;
    connection.set_read_timeout(Some(Duration::from_secs(1)))?;
    io::copy(&mut connection.take(1 << 20), &mut io::sink())?;
    Ok(())
}

/// The request line and the headers, up to the empty line.
fn read_head(connection: &TcpStream) -> io::Result<String> {
    let mut lines = BufReader::new(connection.take(LONGEST_HEAD));
    let mut head = String::new();
    while lines.read_line(&mut head)? > 0 && !head.ends_with("\n\r\n") && !head.ends_with("\n\n") {}
    Ok(head)
}

/// Parts of a request that matter.
#[derive(Debug, PartialEq, Eq)]
struct Request<'a> {
    method: &'a str,
    address: &'a str,
    /// Encodings that the browser accepts.
    accepted: &'a str,
}

impl<'a> Request<'a> {
    fn read(head: &'a str) -> Option<Self> {
        let mut lines = head.lines();
        let mut words = lines.next()?.split(' ');
        let (method, address, version) = (words.next()?, words.next()?, words.next()?);
        let is_http = version.starts_with("HTTP/1.") && address.starts_with('/');
        let accepted = lines
            .filter_map(|line| line.split_once(':'))
            .find(|(name, _)| name.eq_ignore_ascii_case("accept-encoding"))
            .map_or("", |(_, value)| value.trim());
        is_http.then_some(Self {
            method,
            address,
            accepted,
        })
    }
}

fn send(connection: &mut TcpStream, request: &Request, file: &Path) -> io::Result<()> {
    let (stored, encoding) = stored_form(file, request.accepted);
    let mut content = File::open(stored)?;
    let length = content.metadata()?.len();
    let encoding = encoding
        .map(|name| format!("Content-Encoding: {name}\r\n"))
        .unwrap_or_default();
    write!(
        connection,
        "HTTP/1.1 200 OK\r\nContent-Type: {}\r\nContent-Length: {length}\r\n{encoding}\
         Cache-Control: no-cache\r\nVary: Accept-Encoding\r\nX-Content-Type-Options: nosniff\r\n\
         Connection: close\r\n\r\n",
        media_type(file)
    )?;
    if request.method == "GET" {
        io::copy(&mut content, connection)?;
    }
    connection.flush()
}

/// Answers without a file; `headers` end in a line break each.
fn refuse(connection: &mut TcpStream, status: &str, headers: &str) -> io::Result<()> {
    write!(
        connection,
        "HTTP/1.1 {status}\r\nContent-Type: text/plain; charset=utf-8\r\n{headers}\
         Content-Length: {}\r\nConnection: close\r\n\r\n{status}\n",
        status.len() + 1
    )?;
    connection.flush()
}

#[cfg(test)]
mod tests {
    use std::net::TcpListener;

    use super::*;

    /// The answer of a server that serves this package's folder.
    fn asked(request: &str) -> String {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let server = std::thread::spawn(move || {
            let own = Path::new(env!("CARGO_MANIFEST_DIR"))
                .canonicalize()
                .unwrap();
            let (connection, _) = listener.accept().unwrap();
            answer(connection, &own).unwrap();
        });
        let mut browser = TcpStream::connect(address).unwrap();
        browser.write_all(request.as_bytes()).unwrap();
        let mut text = String::new();
        browser.read_to_string(&mut text).unwrap();
        drop(browser);
        server.join().unwrap();
        text
    }

    #[test]
    fn a_file_is_sent_whole_with_its_type() {
        let text = asked("GET /Cargo.toml HTTP/1.1\r\nHost: here\r\n\r\n");
        assert!(text.starts_with("HTTP/1.1 200 OK\r\n"), "{text}");
        let (_, body) = text.split_once("\r\n\r\n").unwrap();
        assert_eq!(body, include_str!("../../Cargo.toml"));
    }

    #[test]
    fn asking_for_the_head_brings_no_body() {
        let text = asked("HEAD /Cargo.toml HTTP/1.1\r\n\r\n");
        let (head, body) = text.split_once("\r\n\r\n").unwrap();
        let length = include_str!("../../Cargo.toml").len();
        assert!(
            head.contains(&format!("Content-Length: {length}")),
            "{head}"
        );
        assert_eq!(body, "");
    }

    #[test]
    fn what_is_not_there_not_allowed_or_not_http_is_refused() {
        assert!(asked("GET /none HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 404 "));
        assert!(asked("GET /../Cargo.lock HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 404 "));
        assert!(asked("POST / HTTP/1.1\r\n\r\nbody").starts_with("HTTP/1.1 405 "));
        assert!(asked("hello\r\n\r\n").starts_with("HTTP/1.1 400 "));
    }

    #[test]
    fn the_names_of_headers_may_be_written_in_any_case() {
        let request = Request::read("GET /a HTTP/1.1\r\nACCEPT-encoding: br\r\n\r\n").unwrap();
        assert_eq!(
            request,
            Request {
                method: "GET",
                address: "/a",
                accepted: "br"
            }
        );
    }
}
