//! SVG output.

use std::fmt::Write as _;

use crate::frames::drawing::{Colour, Drawing, Shape};
use crate::frames::forest::Forest;

impl Forest {
    /// SVG of the trees, with the time of recording \[s\].
    #[must_use]
    pub fn svg(&self, recorded_at: &str) -> String {
        write(&Drawing::of(self, recorded_at))
    }
}

fn write(drawing: &Drawing) -> String {
    let [width, height] = drawing.size;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.2} {height:.2}\" font-family=\"Helvetica, Arial, sans-serif\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for shape in &drawing.shapes {
        put(&mut text, shape);
    }
    text.push_str("</svg>\n");
    text
}

/// Writing to a String cannot fail.
fn put(out: &mut String, shape: &Shape) {
    let dashes = |is_dashed: bool| if is_dashed { " stroke-dasharray=\"4 3\"" } else { "" };
    match shape {
        Shape::Card { at: [x, y], size: [width, height], round, fill, stroke, is_dashed } => {
            let _ = writeln!(
                out,
                "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" \
                 rx=\"{round:.1}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.2\"{}/>",
                hex(*fill),
                hex(*stroke),
                dashes(*is_dashed)
            );
        }
        Shape::Curve { points: [a, b, c, d], stroke, is_dashed } => {
            let _ = writeln!(
                out,
                "<path d=\"M{:.2} {:.2}C{:.2} {:.2} {:.2} {:.2} {:.2} {:.2}\" fill=\"none\" \
                 stroke=\"{}\" stroke-width=\"1.2\"{}/>",
                a[0],
                a[1],
                b[0],
                b[1],
                c[0],
                c[1],
                d[0],
                d[1],
                hex(*stroke),
                dashes(*is_dashed)
            );
        }
        Shape::Head { tip: [x, y], fill } => {
            let _ = writeln!(out, "<path d=\"M{x:.2} {y:.2}l-4 -7h8z\" fill=\"{}\"/>", hex(*fill));
        }
        Shape::Text { at: [x, y], text, size, is_bold, is_centred, fill } => {
            let weight = if *is_bold { " font-weight=\"bold\"" } else { "" };
            let anchor = if *is_centred { " text-anchor=\"middle\"" } else { "" };
            let _ = writeln!(
                out,
                "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size}\"{weight}{anchor} \
                 fill=\"{}\">{}</text>",
                hex(*fill),
                escaped(text)
            );
        }
    }
}

fn hex([red, green, blue]: Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn escaped(text: &str) -> String {
    let clean: String = text.chars().map(|it| if it.is_control() { ' ' } else { it }).collect();
    clean.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
