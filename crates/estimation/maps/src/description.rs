//! YAML description of a map.

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, SourceMap, Span};
use periplus_geometry::Pose2;
use periplus_grid::{MAX_ORIGIN_M, RESOLUTION_RANGE_M, is_origin, is_resolution};
use periplus_yaml::YamlNode;

use crate::distro::{Distro, Mode};
use crate::rule::Rule;

/// Contents of the YAML file.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Path of the image, relative to the folder of the YAML file.
    pub image: String,
    /// Position of `image` in the file.
    pub image_span: Option<Span>,
    /// Side length of a cell \[m\].
    pub resolution_m: f64,
    /// `map_from_grid`: pose of the lower left corner of the lower left pixel.
    pub origin: Pose2,
    /// Minimum darkness of occupied cells, 0 to 1.
    pub occupied_thresh: f64,
    /// Maximum darkness of free cells, 0 to 1.
    pub free_thresh: f64,
    /// True if white is occupied and black is free.
    pub negate: bool,
    /// Interpretation of the brightness.
    pub mode: Mode,
}

impl Description {
    /// Creates the description of an image; all other values are those of `map_saver`.
    #[must_use]
    pub fn of_image(image: impl Into<String>, resolution_m: f64) -> Self {
        Self {
            image: image.into(),
            image_span: None,
            resolution_m,
            origin: Pose2::IDENTITY,
            occupied_thresh: 0.65,
            free_thresh: 0.196,
            negate: false,
            mode: Mode::Trinary,
        }
    }

    /// Returns the rule that interprets pixels.
    #[must_use]
    pub fn rule(&self, distro: Distro) -> Rule {
        Rule {
            distro,
            mode: self.mode,
            negate: self.negate,
            occupied_thresh: self.occupied_thresh,
            free_thresh: self.free_thresh,
        }
    }
}

/// Keys of a description; all except `mode` are required.
const KEYS: [&str; 7] =
    ["image", "resolution", "origin", "occupied_thresh", "free_thresh", "negate", "mode"];

/// Example for error messages.
const EXAMPLE: &str = "a map's YAML has `image: room.pgm`, `resolution: 0.05`, \
     `origin: [-10.0, -10.0, 0.0]`, `negate: 0`, `occupied_thresh: 0.65`, `free_thresh: 0.196`";

/// Reads a description; none when a required key is missing or wrong.
pub fn read_description(
    file: FileId,
    sources: &SourceMap,
    distro: Distro,
    diagnostics: &mut Diagnostics,
) -> Option<Description> {
    let whole = sources.whole(file);
    let node = match periplus_yaml::parse(file, sources) {
        Ok(node) => node,
        Err(wrong) => {
            diagnostics.push(*wrong);
            return None;
        }
    };
    let Some(entries) = node.as_ref().and_then(YamlNode::entries) else {
        let what = node.as_ref().map_or("nothing", YamlNode::kind);
        let wrong = format!("the description of a map must be a mapping, not {what}");
        let span = node.as_ref().map_or(whole, |node| node.span);
        diagnostics.push(Diagnostic::error("bad-map", wrong).at(span).help(EXAMPLE));
        return None;
    };
    for (key, _) in entries {
        let name = key.text().unwrap_or_default();
        if !KEYS.contains(&name) {
            let wrong = format!("`{name}` is not a key of map descriptions; it is ignored");
            diagnostics.push(
                Diagnostic::warning("unknown-key", wrong)
                    .at(key.span)
                    .did_you_mean(key.span, name, KEYS),
            );
        }
    }
    let mut reader = Reader { map: node.as_ref()?, whole, diagnostics };
    let image = reader.image();
    let resolution_m = reader.resolution();
    let origin = reader.origin(distro);
    let occupied_thresh = reader.number("occupied_thresh", "0.65");
    let free_thresh = reader.number("free_thresh", "0.196");
    let negate = reader.negate();
    let mode = reader.mode(distro);
    let (image, image_span) = image?;
    let description = Description {
        image,
        image_span: Some(image_span),
        resolution_m: resolution_m?,
        origin: origin?,
        occupied_thresh: occupied_thresh?,
        free_thresh: free_thresh?,
        negate: negate?,
        mode: mode?,
    };
    reader.doubts(&description);
    Some(description)
}

struct Reader<'a> {
    map: &'a YamlNode,
    whole: Span,
    diagnostics: &'a mut Diagnostics,
}

impl<'a> Reader<'a> {
    fn wrong(&mut self, message: String, span: Span, help: &str) {
        self.diagnostics.push(Diagnostic::error("bad-map", message).at(span).help(help));
    }

    fn required(&mut self, key: &str, example: &str) -> Option<&'a YamlNode> {
        let node = self.map.get(key);
        let given = node.filter(|node| !node.is_null());
        if given.is_none() {
            let span = node.map_or(self.whole, |node| node.span);
            let help = format!("write `{key}: {example}`");
            self.wrong(format!("the description of the map lacks `{key}`"), span, &help);
        }
        given
    }

    fn image(&mut self) -> Option<(String, Span)> {
        let node = self.required("image", "room.pgm")?;
        let span = node.span;
        match node.text() {
            Some(text) if !text.is_empty() => Some((text.to_owned(), span)),
            _ => {
                let help = "write the image file, relative to this file: `image: room.pgm`";
                self.wrong("`image` is empty".into(), span, help);
                None
            }
        }
    }

    fn number(&mut self, key: &str, example: &str) -> Option<f64> {
        let node = self.required(key, example)?;
        let (span, kind) = (node.span, node.kind());
        let number = number_of(node);
        if number.is_none() {
            let help = format!("write `{key}: {example}`");
            self.wrong(format!("`{key}` must be a finite number; this is {kind}"), span, &help);
        }
        number
    }

    fn resolution(&mut self) -> Option<f64> {
        let resolution_m = self.number("resolution", "0.05")?;
        if is_resolution(resolution_m) {
            return Some(resolution_m);
        }
        let span = self.map.get("resolution").map_or(self.whole, |node| node.span);
        let [shortest_m, longest_m] = RESOLUTION_RANGE_M;
        let wrong = if resolution_m > 0.0 {
            format!(
                "the resolution is {resolution_m:?} m; it must be from {shortest_m:?} m to \
                 {longest_m} m"
            )
        } else {
            format!("the resolution is {resolution_m}; it must be positive")
        };
        self.wrong(wrong, span, "write the side length of a pixel in metres: `resolution: 0.05`");
        None
    }

    fn origin(&mut self, distro: Distro) -> Option<Pose2> {
        let node = self.required("origin", "[0.0, 0.0, 0.0]")?;
        let span = node.span;
        let help =
            "write x, y [m] and yaw [rad] of the lower left pixel: `origin: [-10.0, -10.0, 0.0]`";
        let Some(list) = node.list() else {
            let wrong =
                format!("`origin` must be a list of three numbers; this is {}", node.kind());
            self.wrong(wrong, span, help);
            return None;
        };
        // ROS 1 reads the first three and ignores the rest.
        let fits = list.len() == 3 || distro == Distro::Noetic && list.len() > 3;
        if !fits {
            let wrong = format!("`origin` must have 3 numbers, not {}", list.len());
            self.wrong(wrong, span, help);
            return None;
        }
        let bad = list[..3].iter().find(|part| number_of(part).is_none()).map(|part| part.span);
        if let Some(bad) = bad {
            self.wrong("a number of `origin` is missing or not finite".into(), bad, help);
            return None;
        }
        let mut numbers = list.iter().map_while(number_of);
        let mut next = || numbers.next().unwrap_or(0.0);
        let origin = Pose2::new(next(), next(), next());
        if !is_origin(origin) {
            let wrong = format!("`origin` is beyond {MAX_ORIGIN_M:?} m");
            self.wrong(wrong, span, help);
            return None;
        }
        Some(origin)
    }

    fn negate(&mut self) -> Option<bool> {
        let node = self.required("negate", "0")?;
        let (span, kind) = (node.span, node.kind());
        let whole = node.text().and_then(|text| text.parse::<i64>().ok());
        let negate = whole.map(|number| number != 0).or_else(|| node.truth());
        if negate.is_none() {
            let wrong = format!("`negate` must be 0, 1, true or false; this is {kind}");
            self.wrong(wrong, span, "write `negate: 0`, or 1 where white is occupied");
        }
        negate
    }

    fn mode(&mut self, distro: Distro) -> Option<Mode> {
        let Some(node) = self.map.get("mode") else { return Some(Mode::Trinary) };
        let span = node.span;
        let name = node.text().unwrap_or_default();
        // ROS 1 accepts lower case only.
        let is_known = distro != Distro::Noetic || name == name.to_ascii_lowercase();
        if let Some(mode) = Mode::from_name(name).filter(|_| is_known) {
            return Some(mode);
        }
        let wrong = format!("`{name}` is not a map mode");
        self.diagnostics.push(
            Diagnostic::error("bad-map", wrong)
                .at(span)
                .did_you_mean(span, name, Mode::ALL.map(Mode::name))
                .help("modes are `trinary`, `scale` and `raw`"),
        );
        None
    }

    /// Warns about values that are valid but probably unintended.
    fn doubts(&mut self, description: &Description) {
        let Description { free_thresh, occupied_thresh, mode, .. } = *description;
        if mode != Mode::Raw && free_thresh >= occupied_thresh {
            let span = self.map.get("free_thresh").map_or(self.whole, |node| node.span);
            let wrong = format!(
                "`free_thresh` {free_thresh} is not below `occupied_thresh` {occupied_thresh}, so no \
                 pixel is unknown"
            );
            self.diagnostics.push(
                Diagnostic::warning("odd-thresholds", wrong)
                    .at(span)
                    .help("common values are `free_thresh: 0.196` and `occupied_thresh: 0.65`"),
            );
        }
    }
}

/// Reads a number with or without quotes, as the parsers of ROS do.
fn number_of(node: &YamlNode) -> Option<f64> {
    let text = node.text()?.trim();
    let is_number = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    text.parse().ok().filter(|number: &f64| is_number && number.is_finite())
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::{RenderStyle, render};

    use super::*;

    fn read(text: &str, distro: Distro) -> (Option<Description>, String) {
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add("room.yaml", text);
        let description = read_description(file, &sources, distro, &mut diagnostics);
        let shown = diagnostics.iter().map(|it| render(it, &sources, RenderStyle::Plain)).collect();
        (description, shown)
    }

    const GOOD: &str = "image: a.pgm\nresolution: 0.05\norigin: [1, 2.5, -1e-1]\nnegate: 0\n\
                        occupied_thresh: 0.65\nfree_thresh: '0.196'\n";

    #[test]
    fn all_that_is_said() {
        let (description, shown) = read(GOOD, Distro::Jazzy);
        let description = description.unwrap();
        assert_eq!(description.origin, Pose2::new(1.0, 2.5, -0.1));
        assert_eq!((description.mode, description.negate), (Mode::Trinary, false));
        assert_eq!((description.free_thresh, shown.as_str()), (0.196, ""));
        let (description, _) = read(&format!("{GOOD}mode: Scale\n"), Distro::Jazzy);
        assert_eq!(description.unwrap().mode, Mode::Scale);
        assert!(read(&format!("{GOOD}mode: Scale\n"), Distro::Noetic).0.is_none());
        assert!(read(&GOOD.replace("negate: 0", "negate: yes"), Distro::Jazzy).0.unwrap().negate);
    }

    #[test]
    fn each_mistake_has_its_place() {
        let cases = [
            ("origin: [1, 2.5, -1e-1]", "origin: [1, 2.5]", "room.yaml:3:9", "not 2"),
            ("origin: [1, 2.5, -1e-1]", "origin: [1, x, 0]", "room.yaml:3:13", "missing"),
            ("resolution: 0.05", "resolution: 0", "room.yaml:2:13", "positive"),
            ("resolution: 0.05", "resolution: .nan", "room.yaml:2:13", "finite"),
            ("resolution: 0.05\n", "", "room.yaml:1:1", "`resolution`"),
            ("negate: 0", "negate: maybe", "room.yaml:4:9", "true or false"),
            ("image: a.pgm", "image: ''", "room.yaml:1:8", "is empty"),
            ("image: a.pgm", "image: a.pgm\nmode: trinery", "room.yaml:2:7", "did you mean"),
        ];
        for (good, bad, place, words) in cases {
            let (description, shown) = read(&GOOD.replace(good, bad), Distro::Jazzy);
            assert_eq!(description, None, "{bad}");
            assert!(shown.contains(place) && shown.contains(words), "{shown}");
        }
        assert!(read("", Distro::Jazzy).1.contains("nothing"));
        assert!(read("[1]", Distro::Jazzy).1.contains("a list"));
    }

    #[test]
    fn what_is_hardly_meant_is_said() {
        let (description, shown) = read(&GOOD.replace("0.65", "0.1"), Distro::Jazzy);
        assert!(description.is_some() && shown.contains("no pixel is unknown"), "{shown}");
        let (description, shown) = read(&format!("{GOOD}ocupied_thresh: 1\n"), Distro::Jazzy);
        assert!(description.is_some() && shown.contains("occupied_thresh"), "{shown}");
    }
}
