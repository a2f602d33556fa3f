//! This file takes the head of a request apart: one method, one address, one host.

/// Most lines of a head.
const MOST_HEADERS: usize = 64;

/// What somebody asks for.
#[derive(Debug)]
pub struct Asked {
    /// The method.
    pub method: String,
    /// The address behind the host.
    pub url: String,
    /// The host as the client calls it.
    pub host: Option<String>,
}

/// What a head asks for, or the status and the words with which it is refused.
pub fn asked(bytes: &[u8]) -> Result<Asked, (u16, &'static str)> {
    const NO_REQUEST: (u16, &str) = (400, "This is no request.");
    let mut lines = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut request = httparse::Request::new(&mut lines);
    match request.parse(bytes) {
        Ok(httparse::Status::Complete(_)) => {}
        Err(httparse::Error::TooManyHeaders) => {
            return Err((431, "The request has too many headers."));
        }
        _ => return Err(NO_REQUEST),
    }
    let mut hosts = request.headers.iter();
    let hosts = hosts
        .by_ref()
        .filter(|line| line.name.eq_ignore_ascii_case("host"));
    let hosts: Vec<&[u8]> = hosts.map(|line| line.value).collect();
    let host = match hosts.as_slice() {
        [] => None,
        [one] => std::str::from_utf8(one).ok().map(str::to_owned),
        _ => return Err(NO_REQUEST),
    };
    let (method, url) = request.method.zip(request.path).ok_or(NO_REQUEST)?;
    Ok(Asked {
        method: method.to_owned(),
        url: url.to_owned(),
        host,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_one_request_of_one_host() {
        let of =
            |text: &str| asked(text.as_bytes()).map(|asked| (asked.method, asked.url, asked.host));
        let own = of("GET /a?b HTTP/1.1\r\nhOsT: localhost:1\r\n\r\n").unwrap();
        assert_eq!(own.0, "GET");
        assert_eq!(
            (own.1.as_str(), own.2.as_deref()),
            ("/a?b", Some("localhost:1"))
        );
        let two = "GET / HTTP/1.1\r\nHost: localhost:1\r\nHost: evil\r\n\r\n";
        assert_eq!(of(two).unwrap_err().0, 400);
        assert_eq!(of("GET\r\n\r\n").unwrap_err().0, 400);
        let many = "X: y\r\n".repeat(65);
        assert_eq!(
            of(&format!("GET / HTTP/1.1\r\n{many}\r\n")).unwrap_err().0,
            431
        );
    }
}
