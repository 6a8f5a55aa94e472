//! Large worlds.
#![allow(clippy::disallowed_methods, reason = "this test measures time")]

mod common;

use std::fmt::Write as _;
use std::time::{Duration, Instant};

/// A release build reads 20 MB in well under a second; the limit here only catches work that
/// grows with the square of the size.
#[test]
fn time_grows_with_size_not_with_its_square() {
    let time = |models: usize| {
        let mut text = String::from("<sdf version=\"1.9\"><world name=\"w\">");
        for index in 0..models {
            let before = index.checked_sub(1).map_or("world".into(), |it| format!("m{it}"));
            let _ = write!(
                text,
                "<model name=\"m{index}\"><pose relative_to=\"{before}\">1 0 0 0 0 0</pose>\
                 <link name=\"l\"><collision name=\"c\"><geometry><sphere><radius>1</radius>\
                 </sphere></geometry></collision></link></model>",
            );
        }
        text.push_str("</world></sdf>");
        let start = Instant::now();
        let scene = common::read(&text);
        assert_eq!(scene.worlds[0].models.len(), models);
        start.elapsed()
    };
    let small = time(1_000).max(Duration::from_millis(2));
    let large = time(16_000);
    assert!(large < small * 100, "{small:?} for 1000 models, {large:?} for 16000");
}
