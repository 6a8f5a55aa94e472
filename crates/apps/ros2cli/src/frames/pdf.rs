//! PDF output, one page. Characters outside Latin 1 become `?`, because only standard fonts are
//! used, without embedding.

use pdf_writer::types::LineCapStyle;
use pdf_writer::{Content, Finish as _, Name, Pdf, Rect, Ref, Str, TextStr};

use crate::frames::drawing::{Colour, Drawing, Shape};
use crate::frames::forest::Forest;
use crate::frames::widths::width;

/// Maximum size of a page (PDF 1.7, annex C).
const MAX_PAGE_PT: f64 = 14_400.0;

/// Position of the control points of a quarter circle, as a fraction of its radius.
const ARC_CONTROL_FACTOR: f64 = 0.552_284_75;

impl Forest {
    /// PDF of the trees, with the time of recording \[s\].
    #[must_use]
    pub fn pdf(&self, recorded_at: &str) -> Vec<u8> {
        write(&Drawing::of(self, recorded_at))
    }
}

fn write(drawing: &Drawing) -> Vec<u8> {
    let [width, height] = drawing.size;
    let scale = (MAX_PAGE_PT / width.max(height)).min(1.0);
    let [catalog, pages, page, text, bold, content, info] = [1, 2, 3, 4, 5, 6, 7].map(Ref::new);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.document_info(info).title(TextStr("view_frames Result")).creator(TextStr("Periplus"));
    pdf.pages(pages).kids([page]).count(1);
    let mut sheet = pdf.page(page);
    sheet.media_box(Rect::new(0.0, 0.0, short(scale * width), short(scale * height)));
    sheet.parent(pages).contents(content);
    sheet.resources().fonts().pair(Name(b"T"), text).pair(Name(b"B"), bold);
    sheet.finish();
    let fonts = [(text, Name(b"Helvetica")), (bold, Name(b"Helvetica-Bold"))];
    for (font, name) in fonts {
        pdf.type1_font(font).base_font(name).encoding_predefined(Name(b"WinAnsiEncoding"));
    }
    let mut ink = Content::new();
    // From points below the upper edge to points above the lower edge.
    ink.transform([short(scale), 0.0, 0.0, short(scale), 0.0, 0.0]);
    ink.set_line_width(1.0).set_line_cap(LineCapStyle::ButtCap);
    for shape in &drawing.shapes {
        put(&mut ink, shape, height);
    }
    pdf.stream(content, &ink.finish());
    pdf.finish()
}

fn put(ink: &mut Content, shape: &Shape, height: f64) {
    let up = |[x, y]: [f64; 2]| [short(x), short(height - y)];
    match shape {
        Shape::Card { at, size, round, fill, stroke, is_dashed } => {
            fill_with(ink, *fill);
            stroke_with(ink, *stroke, *is_dashed);
            card(ink, *at, *size, *round, &up);
            ink.fill_nonzero_and_stroke();
        }
        Shape::Curve { points: [a, b, c, d], stroke, is_dashed } => {
            stroke_with(ink, *stroke, *is_dashed);
            let ([x, y], [bx, by], [cx, cy], [dx, dy]) = (up(*a), up(*b), up(*c), up(*d));
            ink.move_to(x, y).cubic_to(bx, by, cx, cy, dx, dy).stroke();
        }
        Shape::Head { tip, fill } => {
            fill_with(ink, *fill);
            let [x, y] = up(*tip);
            ink.move_to(x, y).line_to(x - 4.0, y + 7.0).line_to(x + 4.0, y + 7.0);
            ink.close_path().fill_nonzero();
        }
        Shape::Text { at: [x, y], text, size, is_bold, is_centred, fill } => {
            fill_with(ink, *fill);
            let shift = if *is_centred { 0.5 * width(text, *size, *is_bold) } else { 0.0 };
            let [x, y] = up([x - shift, *y]);
            let font = if *is_bold { Name(b"B") } else { Name(b"T") };
            ink.begin_text().set_font(font, short(*size)).next_line(x, y);
            ink.show(Str(&latin(text))).end_text();
        }
    }
}

fn card(
    ink: &mut Content,
    [x, y]: [f64; 2],
    [width, height]: [f64; 2],
    round: f64,
    up: &dyn Fn([f64; 2]) -> [f32; 2],
) {
    let (right, bottom, near) = (x + width, y + height, round * (1.0 - ARC_CONTROL_FACTOR));
    let corners = [
        [[right - round, y], [right - near, y], [right, y + near], [right, y + round]],
        [
            [right, bottom - round],
            [right, bottom - near],
            [right - near, bottom],
            [right - round, bottom],
        ],
        [[x + round, bottom], [x + near, bottom], [x, bottom - near], [x, bottom - round]],
        [[x, y + round], [x, y + near], [x + near, y], [x + round, y]],
    ];
    let [start_x, start_y] = up([x + round, y]);
    ink.move_to(start_x, start_y);
    for corner in corners {
        let [[x, y], [ax, ay], [bx, by], [end_x, end_y]] = corner.map(up);
        ink.line_to(x, y).cubic_to(ax, ay, bx, by, end_x, end_y);
    }
    ink.close_path();
}

fn fill_with(ink: &mut Content, colour: Colour) {
    let [red, green, blue] = colour.map(|part| f32::from(part) / 255.0);
    ink.set_fill_rgb(red, green, blue);
}

fn stroke_with(ink: &mut Content, colour: Colour, is_dashed: bool) {
    let [red, green, blue] = colour.map(|part| f32::from(part) / 255.0);
    ink.set_stroke_rgb(red, green, blue);
    let dashes = if is_dashed { vec![4.0, 3.0] } else { Vec::new() };
    ink.set_dash_pattern(dashes, 0.0);
}

#[expect(clippy::cast_possible_truncation, reason = "points on a page")]
fn short(length: f64) -> f32 {
    length as f32
}

fn latin(text: &str) -> Vec<u8> {
    let byte = |letter: char| match u8::try_from(u32::from(letter)) {
        Ok(byte) if !letter.is_control() => byte,
        _ => b'?',
    };
    text.chars().map(byte).collect()
}
