//! Parser of URIs.

use crate::fuel::FuelUri;
use crate::miss::ResolveError;

/// Maximum length of a URI that is searched [bytes]; Linux refuses longer paths.
const MAX_URI_BYTES: usize = 4096;
/// Maximum length of one file or folder name [bytes].
const MAX_NAME_BYTES: usize = 255;

/// Parsed URI.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Uri {
    /// `package://name/rest` or `model://name/rest`; `rest` may be empty.
    Named { scheme: Scheme, name: String, rest: String },
    /// Path, absolute or relative to the referring file's folder.
    Path(String),
    /// `file://` with a relative path, as `file://media/...` in Gazebo Classic, whose base is unspecified.
    Loose(String),
    /// Model or world in the Fuel cache.
    Fuel(FuelUri),
}

/// Scheme of a named folder. Both have the same search paths; they differ in the preferred folder if only
/// the folder itself is requested.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Scheme {
    Package,
    Model,
}

impl Scheme {
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Package => "package",
            Self::Model => "model",
        }
    }
}

const SCHEMES: [&str; 5] = ["package", "model", "file", "https", "http"];

pub(crate) fn parse(written: &str) -> Result<Uri, ResolveError> {
    let uri = written.trim();
    let bad = |reason: &str| ResolveError::malformed(uri, reason);
    if uri.is_empty() {
        return Err(bad("it is empty"));
    }
    if uri.contains('\0') {
        return Err(bad("it contains a NUL character"));
    }
    if uri.len() > MAX_URI_BYTES {
        return Err(bad("it is longer than any path may be"));
    }
    if uri.split('/').any(|part| part.len() > MAX_NAME_BYTES) {
        return Err(bad("one of its names is longer than 255 bytes"));
    }
    if uri.contains("$(") || uri.contains("${") {
        return Err(bad("it contains a substitution that only xacro makes")
            .help("expand the file with xacro first: name it `.xacro`, or write the value out"));
    }
    let Some((scheme, rest)) = uri.split_once("://") else {
        return without_scheme(uri);
    };
    match scheme.to_ascii_lowercase().as_str() {
        "package" => named(uri, Scheme::Package, rest),
        "model" => named(uri, Scheme::Model, rest),
        "file" => {
            let path = rest.strip_prefix("localhost/").map_or(rest.into(), |p| format!("/{p}"));
            Ok(match path.starts_with('/') {
                true => Uri::Path(path),
                false if path.is_empty() => return Err(bad("it names no file")),
                false => Uri::Loose(path),
            })
        }
        "http" | "https" => remote(uri, rest),
        other => {
            let miss = bad("its scheme is not one that names robot files");
            Err(match periplus_diagnostics::closest(other, SCHEMES) {
                Some(scheme) => miss.help(format!("did you mean `{scheme}://{rest}`?")),
                None => miss.help("known are package://, model://, file:// and Fuel's https://"),
            })
        }
    }
}

fn without_scheme(uri: &str) -> Result<Uri, ResolveError> {
    for scheme in ["package", "model", "file"] {
        if let Some(rest) = uri.strip_prefix(scheme).and_then(|rest| rest.strip_prefix(':')) {
            let rest = rest.trim_start_matches('/');
            return match scheme {
                // `file:/absolute` is valid (RFC 8089, section 2).
                "file" if uri.starts_with("file:/") => Ok(Uri::Path(format!("/{rest}"))),
                _ => Err(ResolveError::malformed(uri, "two slashes must follow the scheme")
                    .help(format!("did you mean `{scheme}://{rest}`?"))),
            };
        }
    }
    Ok(Uri::Path(uri.into()))
}

fn named(uri: &str, scheme: Scheme, rest: &str) -> Result<Uri, ResolveError> {
    let word = scheme.word();
    // Gazebo accepts a third slash, and such files exist.
    let rest = rest.trim_start_matches('/');
    let (name, rest) = rest.split_once('/').unwrap_or((rest, ""));
    match name {
        "" => Err(ResolveError::malformed(uri, format!("it names no {word}"))
            .help(format!("write `{word}://NAME/path/in/it`"))),
        "." | ".." => {
            Err(ResolveError::malformed(uri, format!("`{name}` is not a valid {word} name")))
        }
        _ => {
            let rest = rest.trim_matches('/');
            Ok(Uri::Named { scheme, name: name.into(), rest: rest.into() })
        }
    }
}

fn remote(uri: &str, rest: &str) -> Result<Uri, ResolveError> {
    let (host, path) = rest.split_once('/').unwrap_or((rest, ""));
    if host == "models.gazebosim.org" {
        // Gazebo Classic's model library; downloaded models are in ~/.gazebo/models.
        return named(uri, Scheme::Model, path);
    }
    match FuelUri::parse(host, path) {
        Some(fuel) => Ok(Uri::Fuel(fuel)),
        None => Err(ResolveError::malformed(uri, "nothing is fetched from the network").help(
            "download it beside the file that mentions it, and write its relative path here",
        )),
    }
}

/// Text with `%20` and similar decoded, if that changes it and gives a usable name.
pub(crate) fn percent_decoded(text: &str) -> Option<String> {
    if !text.contains('%') {
        return None;
    }
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let hex = |byte: u8| char::from(byte).to_digit(16);
        let escaped = match after {
            [high, low, ..] if first == b'%' => hex(*high).zip(hex(*low)),
            _ => None,
        };
        rest = match escaped {
            Some((high, low)) => {
                bytes.push(u8::try_from(high * 16 + low).unwrap_or(b'?'));
                &after[2..]
            }
            None => {
                bytes.push(first);
                after
            }
        };
    }
    String::from_utf8(bytes).ok().filter(|decoded| decoded != text && !decoded.contains('\0'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(written: &str, expected: Uri) {
        assert_eq!(parse(written), Ok(expected));
    }

    fn check_bad(written: &str, reason: &str, help: &str) {
        let miss = parse(written).expect_err("a miss");
        assert_eq!((miss.reason.as_str(), miss.help.join("\n").as_str()), (reason, help));
    }

    #[test]
    fn packages_and_models() {
        let named = |scheme, name: &str, rest: &str| Uri::Named {
            scheme,
            name: name.into(),
            rest: rest.into(),
        };
        check("package://bot/meshes/a.stl", named(Scheme::Package, "bot", "meshes/a.stl"));
        check("model:///table/a.dae", named(Scheme::Model, "table", "a.dae"));
        check(" model://sun\n", named(Scheme::Model, "sun", ""));
        check("http://models.gazebosim.org/cafe", named(Scheme::Model, "cafe", ""));
    }

    #[test]
    fn files() {
        check("file:///a/b.dae", Uri::Path("/a/b.dae".into()));
        check("file:/a/b.dae", Uri::Path("/a/b.dae".into()));
        check("file://localhost/a/b.dae", Uri::Path("/a/b.dae".into()));
        check("file://media/x.material", Uri::Loose("media/x.material".into()));
        check("../meshes/b.dae", Uri::Path("../meshes/b.dae".into()));
    }

    #[test]
    fn slips_are_explained() {
        check_bad("", "it is empty", "");
        check_bad("a\0b", "it contains a NUL character", "");
        check_bad(&"x/".repeat(3000), "it is longer than any path may be", "");
        check_bad(&"x".repeat(256), "one of its names is longer than 255 bytes", "");
        check_bad(
            "package:/bot/a.stl",
            "two slashes must follow the scheme",
            "did you mean `package://bot/a.stl`?",
        );
        check_bad("package://", "it names no package", "write `package://NAME/path/in/it`");
        check_bad(
            "pacakge://bot/a.stl",
            "its scheme is not one that names robot files",
            "did you mean `package://bot/a.stl`?",
        );
        check_bad("model://../x", "`..` is not a valid model name", "");
    }

    #[test]
    fn percent_signs() {
        assert_eq!(percent_decoded("Cube%2020k").as_deref(), Some("Cube 20k"));
        assert_eq!(percent_decoded("100%"), None);
        assert_eq!(percent_decoded("a%00b"), None);
        assert_eq!(percent_decoded("%ff"), None);
        assert_eq!(percent_decoded("plain"), None);
    }
}
