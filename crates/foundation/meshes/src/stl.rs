//! STL, ASCII and binary.
//!
//! Layout as in Burns, "Automated Fabrication" (1993), section 6.5. Facet normals are ignored: they follow
//! from the corners, many writers leave them zero, and welded corners have no vertex for them.

use std::collections::HashMap;

use glam::{DMat4, DVec3};

use crate::build::{Corner, Part};
use crate::error::{MeshError, MeshLocation};
use crate::limits::Budget;
use crate::mesh::{Mesh, Submesh};
use crate::notes::Notes;

const HEADER_BYTES: usize = 84;
const FACET_BYTES: usize = 50;

pub(crate) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Mesh, MeshError> {
    // Binary files that begin with "solid" are common (SolidWorks writes them), so an exact length takes
    // precedence over the word.
    let mut notes = Notes::default();
    let is_exactly_binary =
        facet_count(bytes).is_some_and(|count| expected_len(count) == bytes.len());
    let submeshes = if !is_exactly_binary && is_ascii(bytes) {
        ascii(bytes, budget, &mut notes)?
    } else {
        binary(bytes, budget, &mut notes)?
    };
    Ok(Mesh { submeshes, declared_up: None, notes: notes.finish() })
}

/// Returns true if the bytes look like ASCII STL: the word `solid`, soon followed by a word that only the
/// text format has.
pub(crate) fn is_ascii(bytes: &[u8]) -> bool {
    let head = bytes[..bytes.len().min(4096)].trim_ascii_start().to_ascii_lowercase();
    let has = |mark: &[u8]| head.windows(mark.len()).any(|window| window == mark);
    head.starts_with(b"solid") && !head.contains(&0) && (has(b"facet") || has(b"endsolid"))
}

fn facet_count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(80..HEADER_BYTES)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

fn expected_len(count: usize) -> usize {
    count.saturating_mul(FACET_BYTES).saturating_add(HEADER_BYTES)
}

fn binary(bytes: &[u8], budget: &mut Budget, notes: &mut Notes) -> Result<Vec<Submesh>, MeshError> {
    let Some(count) = facet_count(bytes) else {
        return Err(MeshError::new(
            format!("not an STL file: {} bytes are too few", bytes.len()),
            "the file may be empty or a failed download: export or fetch it again",
        )
        .at(MeshLocation::Byte(bytes.len())));
    };
    let expected = expected_len(count);
    if expected > bytes.len() {
        return Err(MeshError::new(
            format!(
                "binary STL promises {count} triangles ({expected} bytes) but has {} bytes",
                bytes.len()
            ),
            "the file is cut short or not an STL: export or fetch it again",
        )
        .at(MeshLocation::Byte(80)));
    }
    if expected < bytes.len() {
        notes.add(format!("{} bytes after the last triangle left out", bytes.len() - expected));
    }
    let mut soup = Soup::default();
    for (i, facet) in bytes[HEADER_BYTES..expected].chunks_exact(FACET_BYTES).enumerate() {
        let mut numbers = facet[12..48]
            .chunks_exact(4)
            .map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])));
        let mut corner = || {
            let mut next = || numbers.next().unwrap_or(f64::NAN);
            DVec3::new(next(), next(), next())
        };
        let corners = [corner(), corner(), corner()];
        let place = MeshLocation::Byte(HEADER_BYTES + i * FACET_BYTES + 12);
        soup.triangle(corners, budget).map_err(|error| error.at(place))?;
    }
    soup.finish(String::new(), notes).map(|part| part.into_iter().collect())
}

/// Triangles without shared vertices; equal positions become one vertex.
#[derive(Default)]
struct Soup {
    part: Part,
    vertex_of_position: HashMap<[u64; 3], u32>,
}

impl Soup {
    fn triangle(&mut self, corners: [DVec3; 3], budget: &mut Budget) -> Result<(), MeshError> {
        let corners = corners.map(|position| {
            // Adding zero makes -0.0 and 0.0 equal.
            let bits = (position + DVec3::ZERO).to_array().map(f64::to_bits);
            let next = u32::try_from(self.vertex_of_position.len()).unwrap_or(u32::MAX);
            let id = *self.vertex_of_position.entry(bits).or_insert(next);
            Corner { key: [id, 0, 0], position, normal: None, uv: None }
        });
        self.part.triangle(corners.each_ref(), budget)
    }

    fn finish(self, name: String, notes: &mut Notes) -> Result<Option<Submesh>, MeshError> {
        if self.part.is_empty() {
            return Ok(None);
        }
        self.part.placed(name, None, DMat4::IDENTITY, notes).map(Some)
    }
}

type Lines<'a> = std::iter::Enumerate<std::slice::Split<'a, u8, fn(&u8) -> bool>>;

/// Words of the text with their line numbers.
struct Words<'a> {
    lines: Lines<'a>,
    line: usize,
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let is_newline: fn(&u8) -> bool = |&b| b == b'\n';
        Words { lines: bytes.split(is_newline).enumerate(), line: 0, rest: &[] }
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            self.rest = self.rest.trim_ascii_start();
            if !self.rest.is_empty() {
                let end = self.rest.iter().position(u8::is_ascii_whitespace);
                let (word, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
                self.rest = rest;
                return Some(word);
            }
            let (line, text) = self.lines.next()?;
            (self.line, self.rest) = (line + 1, text);
        }
    }

    fn rest_of_line(&mut self) -> String {
        String::from_utf8_lossy(std::mem::take(&mut self.rest).trim_ascii()).into_owned()
    }

    fn expect(&mut self, keyword: &str) -> Result<(), MeshError> {
        let found = self.next();
        if found.is_some_and(|word| word.eq_ignore_ascii_case(keyword.as_bytes())) {
            return Ok(());
        }
        Err(self.unexpected(keyword, found))
    }

    fn number(&mut self) -> Result<f64, MeshError> {
        let found = self.next();
        let number = found.and_then(|word| std::str::from_utf8(word).ok()?.parse().ok());
        number.ok_or_else(|| self.unexpected("a number", found))
    }

    fn unexpected(&self, wanted: &str, found: Option<&[u8]>) -> MeshError {
        let found = found.map_or("the end of the file".to_owned(), |word| {
            format!("`{}`", String::from_utf8_lossy(&word[..word.len().min(40)]))
        });
        MeshError::new(
            format!("ASCII STL: expected {wanted}, found {found}"),
            "the file is cut short or damaged: export it again, best as binary STL",
        )
        .at(MeshLocation::Line(self.line))
    }
}

fn ascii(bytes: &[u8], budget: &mut Budget, notes: &mut Notes) -> Result<Vec<Submesh>, MeshError> {
    let mut words = Words::new(bytes);
    let mut submeshes = Vec::new();
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case(b"solid") {
            return Err(words.unexpected("solid", Some(word)));
        }
        let name = words.rest_of_line();
        budget.bytes(name.len())?;
        submeshes.extend(solid(&mut words, budget)?.finish(name, notes)?);
    }
    Ok(submeshes)
}

fn solid(words: &mut Words<'_>, budget: &mut Budget) -> Result<Soup, MeshError> {
    let mut soup = Soup::default();
    loop {
        match words.next() {
            Some(word) if word.eq_ignore_ascii_case(b"facet") => {}
            Some(word) if word.eq_ignore_ascii_case(b"endsolid") => {
                words.rest_of_line();
                return Ok(soup);
            }
            other => return Err(words.unexpected("facet or endsolid", other)),
        }
        words.expect("normal")?;
        // Not-a-number is common here ("nan", "-1.#IND") and has no effect.
        for _ in 0..3 {
            words.next();
        }
        words.expect("outer")?;
        words.expect("loop")?;
        let mut corners = [DVec3::ZERO; 3];
        for corner in &mut corners {
            words.expect("vertex")?;
            *corner = DVec3::new(words.number()?, words.number()?, words.number()?);
        }
        let place = MeshLocation::Line(words.line);
        soup.triangle(corners, budget).map_err(|error| error.at(place))?;
        words.expect("endloop")?;
        words.expect("endfacet")?;
    }
}
