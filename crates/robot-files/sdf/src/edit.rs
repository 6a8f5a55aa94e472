//! Edits of a world's text: elements are moved, removed, renamed and inserted, and all else stays as it is, to the byte.

mod position;

use std::fmt;
use std::ops::Range;

use periplus_diagnostics::{Diagnostics, FileId, Origin, SourceMap, TextEdit, apply_edits};
use periplus_geometry::Pose;
use periplus_xml::{Element, XmlNode, parse, write_element};

use self::position::pose_edit;

/// Change of a child of `<world>`: a model, a light, or an include of one.
#[derive(Clone, Debug, PartialEq)]
pub enum WorldEdit {
    /// Sets the pose in the world; only the element's `<pose>` changes.
    Move {
        /// Origin of the element, as in [`Model::origin`](periplus_scene::Model::origin).
        origin: Origin,
        /// `world_from_model` of the text.
        from: Pose,
        /// New `world_from_model`.
        to: Pose,
    },
    /// Removes the element.
    Remove {
        /// Origin of the element.
        origin: Origin,
    },
    /// Sets the name.
    Rename {
        /// Origin of the element.
        origin: Origin,
        /// New name.
        name: String,
    },
    /// Inserts an element before `</world>`.
    Insert(Element),
}

/// Reason for which a text cannot be edited.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WorldEditError {
    /// The text is no XML with a `<world>` in its root.
    NoWorld,
    /// An element of an edit is no child of the world in this text: another file has it, or a macro wrote it.
    NotInText,
    /// The pose of this element, named as in the text, is relative to a frame that moves too, or has a placement frame
    /// and another reference.
    RelativePose {
        /// Name of the frame.
        frame: String,
    },
    /// The text of a pose is not one of numbers, or two edits change the same bytes.
    Unexpected,
}

impl fmt::Display for WorldEditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoWorld => f.write_str("the text has no `<world>`"),
            Self::NotInText => {
                f.write_str("an element to change is not written in the world's own file")
            }
            Self::RelativePose { frame } => write!(
                f,
                "a pose is relative to `{frame}`, which changes too; write it relative to the world"
            ),
            Self::Unexpected => f.write_str("a `<pose>` is not written as six or seven numbers"),
        }
    }
}

impl std::error::Error for WorldEditError {}

/// Text with its first world and the edits.
struct Editor<'a> {
    text: &'a str,
    world: &'a Element,
    /// Names of elements that move or are removed.
    changing: Vec<String>,
}

/// Returns the text with changes of its first world.
///
/// # Errors
/// The first edit that the text does not allow.
pub fn edit_world(text: &str, edits: &[WorldEdit]) -> Result<String, WorldEditError> {
    let mut sources = SourceMap::new();
    let file: FileId = sources.add("world", text);
    let document = parse(file, &sources, &mut Diagnostics::new()).ok_or(WorldEditError::NoWorld)?;
    let world = document.root.child("world").ok_or(WorldEditError::NoWorld)?;
    let mut editor = Editor { text, world, changing: Vec::new() };
    for edit in edits {
        if let WorldEdit::Move { origin, .. } | WorldEdit::Remove { origin } = edit {
            editor.changing.extend(name_of(editor.find(*origin)?));
        }
    }
    let mut changes: Vec<TextEdit> = Vec::new();
    for edit in edits {
        changes.push(match edit {
            WorldEdit::Move { origin, from, to } => {
                pose_edit(editor.find(*origin)?, (*from, *to), &editor)?
            }
            WorldEdit::Remove { origin } => editor.removal(editor.find(*origin)?)?,
            WorldEdit::Rename { origin, name } => editor.renaming(editor.find(*origin)?, name)?,
            WorldEdit::Insert(element) => editor.insertion(element)?,
        });
    }
    apply_edits(text, changes).ok_or(WorldEditError::Unexpected)
}

/// Returns the name of a child of the world; an include without one has that of its file.
fn name_of(element: &Element) -> Option<String> {
    match &*element.name {
        "include" => element.child("name").map(|name| name.text().into_owned()),
        _ => element.value("name").map(str::to_owned),
    }
}

impl Editor<'_> {
    fn find(&self, origin: Origin) -> Result<&Element, WorldEditError> {
        let wanted = origin.0.ok_or(WorldEditError::NotInText)?;
        let is_it = |element: &&Element| {
            let start = element.origin.0.map(|span| span.start);
            start == Some(wanted.start) && ["model", "light", "include"].contains(&&*element.name)
        };
        self.world.elements().find(is_it).ok_or(WorldEditError::NotInText)
    }

    fn removal(&self, element: &Element) -> Result<TextEdit, WorldEditError> {
        let range = element_range(element, self.text).ok_or(WorldEditError::Unexpected)?;
        // Whole lines, where the element has them for itself.
        let line_start = self.text[..range.start].rfind('\n').map_or(0, |it| it + 1);
        let line_end = self.text[range.end..].find('\n').map(|it| range.end + it + 1);
        let is_blank = |part: &str| part.chars().all(char::is_whitespace);
        let range = match line_end {
            Some(line_end)
                if is_blank(&self.text[line_start..range.start])
                    && is_blank(&self.text[range.end..line_end]) =>
            {
                line_start..line_end
            }
            _ => range,
        };
        Ok(TextEdit { range, text: String::new() })
    }

    fn renaming(&self, element: &Element, name: &str) -> Result<TextEdit, WorldEditError> {
        let escaped = escaped(name);
        let origin = match (&*element.name, element.child("name")) {
            ("include", None) => {
                let text = format!("<name>{escaped}</name>");
                return self.first_child(element, &text);
            }
            ("include", Some(child)) => child.text_origin(),
            _ => element.attribute("name").map(|it| it.value_origin).unwrap_or_default(),
        };
        let span = origin.0.ok_or(WorldEditError::Unexpected)?;
        Ok(TextEdit { range: span.start as usize..span.end as usize, text: escaped })
    }

    /// Inserts text as the first child of an element, on a separate line if its first child has one.
    fn first_child(&self, element: &Element, text: &str) -> Result<TextEdit, WorldEditError> {
        let span = element.origin.0.ok_or(WorldEditError::Unexpected)?;
        let at = span.end as usize;
        if self.text[..at].ends_with("/>") {
            return Err(WorldEditError::Unexpected);
        }
        let rest = &self.text[at..];
        let blank = &rest[..rest.len() - rest.trim_start().len()];
        let text = match blank.rfind('\n') {
            Some(line) => format!("{}{}{text}", self.line_break(), &blank[line + 1..]),
            None => text.to_owned(),
        };
        Ok(TextEdit { range: at..at, text })
    }

    fn insertion(&self, element: &Element) -> Result<TextEdit, WorldEditError> {
        let range = element_range(self.world, self.text).ok_or(WorldEditError::Unexpected)?;
        let close = self.text[range.clone()].rfind("</").map(|it| range.start + it);
        let close = close.ok_or(WorldEditError::Unexpected)?;
        let line_start = self.text[..close].rfind('\n').map_or(0, |it| it + 1);
        let before_close = &self.text[line_start..close];
        let has_line = before_close.chars().all(char::is_whitespace);
        let indent = self.child_indent().unwrap_or_else(|| {
            let before_close = if has_line { before_close } else { "" };
            format!("{before_close}  ")
        });
        let mut text = String::new();
        for line in write_element(element).lines() {
            text.push_str(&indent);
            text.push_str(line);
            text.push_str(self.line_break());
        }
        if has_line {
            return Ok(TextEdit { range: line_start..line_start, text });
        }
        Ok(TextEdit { range: close..close, text: format!("{}{text}", self.line_break()) })
    }

    /// Returns the white space before the last child of the world that begins a line.
    fn child_indent(&self) -> Option<String> {
        let indents = self.world.elements().filter_map(|child| {
            let start = child.origin.0?.start as usize;
            let line_start = self.text[..start].rfind('\n')? + 1;
            let indent = &self.text[line_start..start];
            indent.chars().all(char::is_whitespace).then(|| indent.to_owned())
        });
        indents.last()
    }

    fn line_break(&self) -> &'static str {
        if self.text.contains("\r\n") { "\r\n" } else { "\n" }
    }
}

/// Returns the bytes of an element, from its start tag to its end tag.
fn element_range(element: &Element, text: &str) -> Option<Range<usize>> {
    let span = element.origin.0?;
    let (start, end) = (span.start as usize, span.end as usize);
    if text.get(start..end)?.ends_with("/>") {
        return Some(start..end);
    }
    let last = element.children.iter().rev().find_map(|child| match child {
        XmlNode::Element(child) => element_range(child, text).map(|it| it.end),
        XmlNode::Text(text) | XmlNode::Comment(text) | XmlNode::Instruction(text) => {
            text.origin.0.map(|it| it.end as usize)
        }
    });
    let from = last.unwrap_or(end).max(end);
    let close = from + text.get(from..)?.find("</")?;
    Some(start..close + text[close..].find('>')? + 1)
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;").replace('\'', "&apos;")
}
