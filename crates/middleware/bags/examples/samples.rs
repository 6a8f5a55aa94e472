//! Writes bags for tests of other programs: every message type, with every compression and metadata
//! style. `cargo run -p periplus-bags --example samples -- FOLDER`
#![allow(clippy::disallowed_methods, clippy::print_stderr, reason = "an example is an edge")]

use std::error::Error;
use std::fs;
use std::path::Path;

use periplus_bags::{
    Compression, FileInfo, QosProfile, Settings, Stamp, Style, Topic, Writer, check,
};
use periplus_msgs::{DynamicMessage, Format, TypeRegistry};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("missing argument: output folder")?;
    for (style, style_name) in [(Style::Humble, "humble"), (Style::Jazzy, "jazzy")] {
        for compression in [Compression::None, Compression::Lz4, Compression::Zstd] {
            let packing =
                if compression == Compression::None { "plain" } else { compression.name() };
            let name = format!("{style_name}_{packing}");
            let path = Path::new(&folder).join(&name);
            fs::create_dir_all(&path)?;
            write(&path, &name, style, compression)?;
        }
    }
    Ok(())
}

fn write(
    path: &Path,
    name: &str,
    style: Style,
    compression: Compression,
) -> Result<(), Box<dyn Error>> {
    let file_name = format!("{name}_0.mcap");
    let settings = Settings { style, compression, ..Settings::new(&*file_name) };
    let mut bag = Writer::new(Vec::new(), settings)?;
    let types = TypeRegistry::builtin();
    let mut topics = Vec::new();
    for type_name in types.type_names() {
        let layout = types.layout(type_name).ok_or("a type without layout")?;
        // Parts of services and actions are not published on topics.
        if !type_name.contains("/msg/") {
            continue;
        }
        let Some(schema_text) = types.schema_text(type_name) else { continue };
        let mut json = DynamicMessage::blank(layout).to_json();
        fill(&mut json, &mut 0);
        topics.push((type_name, schema_text, DynamicMessage::from_json(layout, &json)?));
    }
    let qos = [QosProfile::reliable(10), QosProfile::latched(1), QosProfile::sensor_data()];
    for second in 0..3_i64 {
        for (index, (type_name, schema_text, message)) in (0..).zip(&topics) {
            let topic = bag.topic(Topic {
                name: format!("/{}", type_name.replace("/msg/", "/").to_lowercase()),
                type_name: (*type_name).into(),
                schema_text: (*schema_text).into(),
                type_hash: types.hash(type_name).unwrap_or_default(),
                qos: vec![qos[index as usize % 3]],
            })?;
            let mut data = Vec::new();
            message.encode(Format::CDR, &mut data)?;
            bag.write(topic, Stamp::at(second * 1_000_000_000 + index * 1_000), &data)?;
        }
    }
    let (bytes, info) = bag.finish()?;
    let faults = check(&bytes);
    assert!(faults.is_empty(), "{faults:?}");
    let FileInfo { path: file, .. } = &info.files[0];
    fs::write(path.join(file), &bytes)?;
    fs::write(path.join("metadata.yaml"), info.to_yaml(style))?;
    eprintln!("{name}: {} topics, {} bytes", info.topics.len(), bytes.len());
    Ok(())
}

/// Gives every number and text of a message a distinct value.
fn fill(value: &mut serde_json::Value, count: &mut u32) {
    *count = *count % 100 + 1;
    match value {
        serde_json::Value::Bool(truth) => *truth = count.is_multiple_of(2),
        serde_json::Value::Number(number) => *number = (*count).into(),
        serde_json::Value::String(text) => *text = format!("t{count}"),
        serde_json::Value::Array(list) => list.iter_mut().for_each(|one| fill(one, count)),
        serde_json::Value::Object(map) => map.values_mut().for_each(|one| fill(one, count)),
        serde_json::Value::Null => {}
    }
}
