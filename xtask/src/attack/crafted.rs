//! Inputs that no change of a sound file finds: bombs, circles, towers.

/// A hostile input: the end of its name, and its bytes.
pub(super) type Input = (&'static str, Vec<u8>);

fn text(end: &'static str, text: impl Into<String>) -> Input {
    (end, text.into().into_bytes())
}

/// Ten entities, each of ten of the one before.
fn laughs(root: &str) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n<!DOCTYPE x [\n<!ENTITY e0 \"ha\">\n");
    for level in 1..12 {
        let parts = format!("&e{};", level - 1).repeat(10);
        text += &format!("<!ENTITY e{level} \"{parts}\">\n");
    }
    text + &format!("]>\n<{root} name=\"a\">&e11;</{root}>\n")
}

fn tower(open: &str, close: &str, height: usize) -> String {
    open.repeat(height) + &close.repeat(height)
}

/// Inputs that every XML format must survive, under its root element.
pub(super) fn xml(end: &'static str, root: &str) -> Vec<Input> {
    let attributes: String = (0..80_000).map(|at| format!(" a{at}=\"1\"")).collect();
    let of = |content: &str| format!("<{root} name=\"a\">{content}</{root}>");
    vec![
        text(end, laughs(root)),
        text(
            end,
            format!("<!DOCTYPE x [<!ENTITY e SYSTEM \"file:///etc/passwd\">]><{root}>&e;</{root}>"),
        ),
        text(end, of(&tower("<link>", "</link>", 100_000))),
        text(end, of(&"<link>".repeat(200_000))),
        text(end, format!("<{root}{attributes}/>")),
        text(end, of(&"<link name=\"l\"/>".repeat(60_000))),
        text(end, of(&format!("<link name=\"{}\"/>", "n".repeat(2 << 20)))),
        text(end, of(&format!("<!--{}-->", "-".repeat(2 << 20)))),
        text(end, of(&"<![CDATA[".repeat(100_000))),
        text(end, format!("<{root}")),
        text(end, ""),
        text(end, "<".repeat(1 << 20)),
        text(end, of(&"&".repeat(500_000))),
        text(end, of(&"&#x10FFFF;&#0;&#xD800;".repeat(1000))),
    ]
}

/// Robots: chains, circles, many links.
pub(super) fn urdf() -> Vec<Input> {
    let link = |at: usize| format!("<link name=\"l{at}\"/>");
    let joint = |at: usize, parent: usize, child: usize| {
        format!(
            "<joint name=\"j{at}\" type=\"fixed\"><parent link=\"l{parent}\"/><child link=\"l{child}\"/></joint>"
        )
    };
    let many = |count: usize, parent: &dyn Fn(usize) -> usize| {
        let links: String = (0..count).map(link).collect();
        let joints: String = (1..count).map(|at| joint(at, parent(at), at)).collect();
        format!("<robot name=\"r\">{links}{joints}</robot>")
    };
    let ball = "<collision><geometry><sphere radius=\"1\"/></geometry></collision>";
    let blocks = |content: &str| {
        let block = format!("<gazebo reference=\"a\">{content}</gazebo>").repeat(5000);
        let balls = ball.repeat(5000);
        format!(
            "<robot name=\"r\"><link name=\"a\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>{balls}</link>{block}</robot>"
        )
    };
    vec![
        text("urdf", blocks("<mu1>1</mu1><kp>1</kp>")),
        text("urdf", blocks("<collision><plugin name=\"p\" filename=\"p\"/></collision>")),
        text("urdf", many(4000, &|at| at - 1)),
        text("urdf", many(4000, &|_| 0)),
        text("urdf", many(3, &|at| at)),
        text(
            "urdf",
            "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"x\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint><joint name=\"y\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint></robot>",
        ),
        text(
            "urdf",
            "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"/dev/zero\"/></geometry></visual></link></robot>",
        ),
        text(
            "urdf",
            "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"package://../../../../etc/passwd\"/></geometry></visual></link></robot>",
        ),
    ]
}

/// Macros without end, properties that double, includes of itself, expressions that grow.
pub(super) fn xacro() -> Vec<Input> {
    let of = |content: &str| {
        format!(
            "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">{content}<link name=\"a\"/></robot>"
        )
    };
    let mut doubling = String::from("<xacro:property name=\"p0\" value=\"aaaaaaaa\"/>");
    for at in 1..60 {
        let before = at - 1;
        doubling +=
            &format!("<xacro:property name=\"p{at}\" value=\"${{p{before}}}${{p{before}}}\"/>");
    }
    let expressions = [
        "9**9**9",
        "'a' * 10**9",
        "[0] * 10**9",
        "2**2**30",
        "1 << 10**9",
        "'%999999999d' % 1",
        "10**100000",
        "(lambda f: f(f))(lambda f: f(f))",
        "[x for x in range(10**9)]",
        "range(10**12)",
        "list(range(10**9))",
        "sum(range(10**10))",
        "'a'.ljust(10**10)",
        "'%s' * 100000000",
        "__import__('os').system('true')",
        "().__class__.__bases__[0].__subclasses__()",
        "open('/etc/passwd').read()",
        "1/0",
        "0.0/0",
        "float('nan')",
        "-2**63",
        "math.factorial(100000)",
        "max([])",
        "{}[1]",
        "''.join(['a'*1000]*1000000)",
    ];
    let mut inputs: Vec<Input> = expressions
        .iter()
        .map(|expression| text("xacro", of(&format!("<xacro:property name=\"p\" value=\"${{{expression}}}\"/><link name=\"x${{p}}\"/>"))))
        .collect();
    inputs.extend([
        text("xacro", of("<xacro:macro name=\"m\"><xacro:m/></xacro:macro><xacro:m/>")),
        text("xacro", of("<xacro:macro name=\"m\"><xacro:m/><xacro:m/></xacro:macro><xacro:m/>")),
        text("xacro", of("<xacro:include filename=\"$(filename)\"/>")),
        text("xacro", of("<xacro:include filename=\"/dev/zero\"/><xacro:include filename=\"/etc/passwd\"/>")),
        text("xacro", of(&(doubling + "<link name=\"${p59}\"/>"))),
        text("xacro", of("<xacro:property name=\"a\" value=\"${b}\"/><xacro:property name=\"b\" value=\"${a}\"/><link name=\"${a}\"/>")),
        text("xacro", of(&format!("<xacro:property name=\"p\" value=\"${{{}1{}}}\"/><link name=\"${{p}}\"/>", "(".repeat(50_000), ")".repeat(50_000)))),
        text("xacro", of(&format!("<xacro:property name=\"p\" value=\"${{{}1}}\"/><link name=\"${{p}}\"/>", "-".repeat(50_000)))),
        text("xacro", of(&format!("<xacro:property name=\"p\" value=\"${{{}1}}\"/><link name=\"${{p}}\"/>", "not ".repeat(50_000)))),
        text("xacro", of(&tower("<xacro:if value=\"1\">", "</xacro:if>", 50_000))),
        text("xacro", of("$(env HOME) $(find nowhere) $(arg nothing) $(eval 9**9**9)")),
    ]);
    let macros: String = (1..30)
        .map(|at| {
            let before = at - 1;
            format!("<xacro:macro name=\"m{at}\"><xacro:m{before}/><xacro:m{before}/><xacro:m{before}/></xacro:macro>")
        })
        .collect();
    inputs.push(text(
        "xacro",
        of(&format!(
            "<xacro:macro name=\"m0\"><link name=\"x\"/></xacro:macro>{macros}<xacro:m29/>"
        )),
    ));
    inputs
}

/// Worlds: circles of frames and includes, absurd sizes.
pub(super) fn sdf() -> Vec<Input> {
    let world =
        |content: &str| format!("<sdf version=\"1.9\"><world name=\"w\">{content}</world></sdf>");
    let model = |content: &str| {
        world(&format!("<model name=\"m\"><link name=\"l\">{content}</link></model>"))
    };
    let shape = |geometry: &str| {
        model(&format!(
            "<collision name=\"c\"><geometry>{geometry}</geometry></collision><visual name=\"v\"><geometry>{geometry}</geometry></visual>"
        ))
    };
    let frames: String = (0..3000)
        .map(|at| format!("<frame name=\"f{at}\" attached_to=\"f{}\"/>", (at + 1) % 3000))
        .collect();
    let nested = tower("<model name=\"m\"><link name=\"l\"/>", "</model>", 3000);
    let lidar = |samples: &str| {
        model(&format!(
            "<sensor name=\"s\" type=\"gpu_lidar\"><update_rate>1e9</update_rate><lidar><scan><horizontal><samples>{samples}</samples><min_angle>-3</min_angle><max_angle>3</max_angle></horizontal><vertical><samples>{samples}</samples><min_angle>-1</min_angle><max_angle>1</max_angle></vertical></scan><range><min>0.1</min><max>10</max></range></lidar></sensor>"
        ))
    };
    let camera = "<sensor name=\"s\" type=\"camera\"><camera><horizontal_fov>1</horizontal_fov><image><width>1000000</width><height>1000000</height></image><clip><near>0.1</near><far>10</far></clip></camera></sensor>";
    let mut inputs = vec![
        text("sdf", world(&frames)),
        text("sdf", world(&nested)),
        text("sdf", world("<include><uri>file://x.sdf</uri></include>")),
        text("sdf", world("<include><uri>model://../../../../etc</uri></include>")),
        text("sdf", world("<include><uri>/dev/zero</uri></include>")),
        text("sdf", lidar("100000")),
        text("sdf", lidar("2147483647")),
        text("sdf", lidar("-1")),
        text("sdf", model(camera)),
        text(
            "sdf",
            shape("<heightmap><uri>/dev/zero</uri><size>1e308 1e308 1e308</size></heightmap>"),
        ),
        text(
            "sdf",
            world(
                "<population name=\"p\"><model name=\"a\"><link name=\"l\"/></model><model_count>2000000000</model_count><distribution><type>grid</type><rows>1000000</rows><cols>1000000</cols></distribution><box><size>1 1 1</size></box></population>",
            ),
        ),
        text(
            "sdf",
            world(
                "<physics type=\"ode\"><max_step_size>1e-300</max_step_size><real_time_update_rate>1e300</real_time_update_rate></physics>",
            ),
        ),
        text("sdf", world("<physics type=\"ode\"><max_step_size>0</max_step_size></physics>")),
        text("sdf", world("<gravity>1e308 nan -1e308</gravity>")),
    ];
    for number in ["1e308", "nan", "-1", "0", "1e-320", "inf"] {
        inputs.push(text(
            "sdf",
            shape(&format!("<box><size>{number} {number} {number}</size></box>")),
        ));
        inputs.push(text(
            "sdf",
            shape(&format!(
                "<cylinder><radius>{number}</radius><length>{number}</length></cylinder>"
            )),
        ));
        inputs.push(text("sdf", shape(&format!("<polyline><point>0 {number}</point><point>{number} 1</point><point>1 0</point><height>{number}</height></polyline>"))));
        inputs.push(text("sdf", model(&format!("<inertial><mass>{number}</mass><inertia><ixx>{number}</ixx></inertia></inertial><pose>{number} 0 0 0 {number} 0</pose>"))));
    }
    inputs
}

/// Meshes with counts that are not there.
pub(super) fn mesh() -> Vec<Input> {
    let mut stl = vec![b' '; 80];
    stl.extend(u32::MAX.to_le_bytes());
    stl.extend([0; 50]);
    let accessor = |accessor: &str| {
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}}}]}}],\"nodes\":[{{\"mesh\":0}}],\"scenes\":[{{\"nodes\":[0]}}],\"accessors\":[{{{accessor}}}]}}"
        )
    };
    let base = "\"componentType\":5126,\"type\":\"VEC3\"";
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend(u32::MAX.to_le_bytes());
    glb.extend(u32::MAX.to_le_bytes());
    glb.extend(b"JSON{}");
    let obj: String = "v 0 0 0\n".repeat(3) + "f 1 2 3 1 2 3 1 2 3 " + &"1 ".repeat(300_000);
    let dae = |count: &str| {
        format!(
            "<COLLADA version=\"1.4.1\"><library_geometries><geometry id=\"g\"><mesh><source id=\"s\"><float_array id=\"a\" count=\"{count}\">0 0 0</float_array><technique_common><accessor source=\"#a\" count=\"{count}\" stride=\"{count}\"/></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices><triangles count=\"{count}\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"{count}\"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries></COLLADA>"
        )
    };
    let node = "<node id=\"n\"><instance_node url=\"#n\"/><instance_node url=\"#n\"/></node>";
    vec![
        ("stl", stl),
        text(
            "stl",
            "solid x\n".to_owned()
                + &"facet normal 0 0 1\nouter loop\nvertex nan inf 1e999\n".repeat(20_000),
        ),
        text("gltf", accessor(&format!("{base},\"count\":1000000000"))),
        text("gltf", accessor(&format!("{base},\"count\":18446744073709551615"))),
        text(
            "gltf",
            accessor(&format!(
                "{base},\"count\":1000000000,\"sparse\":{{\"count\":1000000000,\"indices\":{{\"bufferView\":0,\"componentType\":5125}},\"values\":{{\"bufferView\":0}}}}"
            )),
        ),
        text(
            "gltf",
            "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"children\":[0,0]}],\"scenes\":[{\"nodes\":[0]}]}",
        ),
        text(
            "gltf",
            format!("{{\"asset\":{{\"version\":\"2.0\"}},\"x\":{}}}", tower("[", "]", 200_000)),
        ),
        text(
            "gltf",
            "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":1000000000000,\"uri\":\"/dev/zero\"}]}",
        ),
        ("glb", glb),
        text("obj", obj),
        text("obj", "v 0 0 0\nf 1/1/1 4294967297 -9223372036854775808\n"),
        text("obj", "mtllib /dev/zero\nusemtl x\nv 0 0 0\nf 1 1 1\n"),
        text("dae", dae("4000000000")),
        text("dae", dae("-1")),
        text(
            "dae",
            format!(
                "<COLLADA version=\"1.4.1\"><library_visual_scenes><visual_scene id=\"v\">{node}</visual_scene></library_visual_scenes></COLLADA>"
            ),
        ),
    ]
}

/// YAML: aliases of aliases, towers, references to itself.
pub(super) fn yaml() -> Vec<Input> {
    let mut bomb = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x]\n");
    for at in 1..12 {
        let parts = vec![format!("*a{}", at - 1); 9].join(", ");
        bomb += &format!("a{at}: &a{at} [{parts}]\n");
    }
    vec![
        text("yaml", bomb),
        text("yaml", "a: &a [*a, *a]\n"),
        text("yaml", "&a {x: *a, <<: *a}\n"),
        text("yaml", tower("[", "]", 100_000)),
        text("yaml", tower("{a: ", "}", 100_000)),
        text("yaml", "- ".repeat(50_000)),
        text("yaml", "? ".repeat(50_000)),
        text("yaml", "!!python/object/apply:os.system [\"true\"]\n"),
        text("yaml", format!("x: |\n  {}\n", "a".repeat(3 << 20))),
        text("yaml", (0..60_000).map(|at| format!("k{at}: {at}\n")).collect::<String>()),
        text("yaml", (0..5_000).map(|at| " ".repeat(at) + "k:\n").collect::<String>()),
        text("yaml", "--- a\n".repeat(50_000)),
        text("yaml", "%YAML 9.9\n---\nx: 2001-99-99T99:99:99\n"),
        text("yaml", "a: 0x".to_owned() + &"f".repeat(100_000)),
    ]
}

/// Maps and their pictures.
pub(super) fn map() -> Vec<Input> {
    let of = |image: &str, resolution: &str, origin: &str| {
        format!(
            "image: {image}\nresolution: {resolution}\norigin: {origin}\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"
        )
    };
    let mut inputs: Vec<Input> = ["1e308", "1e-308", "nan", "inf", "-1", "0", "1e999", "[1]"]
        .iter()
        .map(|number| text("yaml", of("room.pgm", number, "[0, 0, 0]")))
        .collect();
    for origin in
        ["[nan, 0, 0]", "[1e308, -1e308, 1e308]", "[]", "[0]", "{}", "[0, 0, 0, 0, 0, 0, 0]"]
    {
        inputs.push(text("yaml", of("room.pgm", "0.05", origin)));
    }
    for image in
        ["/dev/zero", "/dev/random", ".", "..", "/etc/passwd", "/proc/self/mem", "\"\"", "x.yaml"]
    {
        inputs.push(text("yaml", of(image, "0.05", "[0, 0, 0]")));
    }
    inputs
}

/// Pictures of absurd sizes, for maps.
pub(super) fn pictures() -> Vec<Input> {
    let mut bmp = b"BM".to_vec();
    bmp.extend([0xFF; 8]);
    bmp.extend(54u32.to_le_bytes());
    bmp.extend(40u32.to_le_bytes());
    bmp.extend(0x7FFF_FFFFu32.to_le_bytes());
    bmp.extend(0x7FFF_FFFFu32.to_le_bytes());
    bmp.extend([1, 0, 8, 0]);
    bmp.extend([0; 24]);
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0DIHDR".to_vec();
    png.extend(0x7FFF_FFFFu32.to_be_bytes());
    png.extend(0x7FFF_FFFFu32.to_be_bytes());
    png.extend([8, 6, 0, 0, 0, 0, 0, 0, 0]);
    vec![
        text("pgm", "P5\n1000000 1000000\n255\n"),
        text("pgm", "P5\n99999999999999999999 1\n255\n"),
        text("pgm", "P5\n-1 -1\n255\n"),
        text("pgm", "P5\n0 0\n255\n"),
        text("pgm", "P2\n30000 30000\n255\n0 0 0"),
        text("pgm", "P5\n#".to_owned() + &"x".repeat(2 << 20)),
        text("pgm", "P5\n4 4\n65536\n0123456789abcdef"),
        ("pgm", bmp),
        ("pgm", png),
    ]
}

/// A frame of Zstandard that unpacks to `blocks` times 128 KiB of one byte.
fn zstd_of_one_byte(blocks: usize) -> Vec<u8> {
    // Magic, no checksum and no content size, a window of 128 KiB.
    let mut frame = vec![0x28, 0xB5, 0x2F, 0xFD, 0x00, 0x38];
    for block in 0..blocks {
        let is_last = u32::from(block + 1 == blocks);
        // Block header: last, type 1 (one byte repeated), size.
        let header = is_last | (1 << 1) | ((128 << 10) << 3);
        frame.extend(&header.to_le_bytes()[..3]);
        frame.push(0);
    }
    frame
}

/// Recordings: chunks that unpack to gigabytes, counts that are not there.
pub(super) fn bag() -> Vec<Input> {
    let magic = b"\x89MCAP0\r\n";
    let record = |opcode: u8, content: &[u8]| {
        let mut record = vec![opcode];
        record.extend((content.len() as u64).to_le_bytes());
        record.extend(content);
        record
    };
    let word = |text: &str| {
        let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
        bytes.extend(text.as_bytes());
        bytes
    };
    let chunk = |unpacked: u64, packing: &str, data: &[u8]| {
        let mut content = [0u8; 16].to_vec();
        content.extend(unpacked.to_le_bytes());
        content.extend(0u32.to_le_bytes());
        content.extend(word(packing));
        content.extend((data.len() as u64).to_le_bytes());
        content.extend(data);
        record(0x06, &content)
    };
    let mut header = word("ros2");
    header.extend(word("x"));
    let file = |records: &[Vec<u8>]| {
        let mut bytes = magic.to_vec();
        bytes.extend(record(0x01, &header));
        bytes.extend(records.concat());
        bytes.extend(record(0x0F, &[0; 4]));
        bytes.extend(record(0x02, &[0; 20]));
        bytes.extend(magic);
        bytes
    };
    let channel = |id: u16| {
        let mut content = id.to_le_bytes().to_vec();
        content.extend(0u16.to_le_bytes());
        content.extend(word("/t"));
        content.extend(word("cdr"));
        content.extend(0u32.to_le_bytes());
        record(0x04, &content)
    };
    let bomb = zstd_of_one_byte(32_768);
    let channels: Vec<Vec<u8>> =
        (0..=u16::MAX).step_by(4).chain((0..=u16::MAX).step_by(4)).map(channel).collect();
    let mut ros1 = b"#ROSBAG V2.0\n".to_vec();
    let field = |name: &str, value: &[u8]| {
        let mut field = ((name.len() + 1 + value.len()) as u32).to_le_bytes().to_vec();
        field.extend(name.as_bytes());
        field.push(b'=');
        field.extend(value);
        field
    };
    let part = |fields: &[Vec<u8>], data: &[u8]| {
        let header = fields.concat();
        let mut part = (header.len() as u32).to_le_bytes().to_vec();
        part.extend(&header);
        part.extend((data.len() as u32).to_le_bytes());
        part.extend(data);
        part
    };
    ros1.extend(part(
        &[
            field("op", &[3]),
            field("index_pos", &[0; 8]),
            field("conn_count", &[0xFF; 4]),
            field("chunk_count", &[0xFF; 4]),
        ],
        &[b' '; 100],
    ));
    let mut connections = ros1.clone();
    for at in 0..20_000u32 {
        let data = [
            field("topic", b"/t"),
            field("type", b"a/B"),
            field("md5sum", b"0"),
            field("message_definition", b""),
        ]
        .concat();
        connections.extend(part(
            &[field("op", &[7]), field("conn", &at.to_le_bytes()), field("topic", b"/t")],
            &data,
        ));
    }
    vec![
        ("mcap", file(&[chunk(1 << 32, "zstd", &bomb)])),
        ("mcap", file(&[chunk(100, "zstd", &bomb)])),
        ("mcap", file(&vec![chunk(64 << 20, "zstd", &zstd_of_one_byte(512)); 30])),
        ("mcap", file(&[chunk(u64::MAX, "", b"abc")])),
        ("mcap", file(&[chunk(u64::MAX, "lz4", b"\x04\x22\x4D\x18")])),
        ("mcap", file(&channels)),
        ("mcap", magic.to_vec()),
        ("bag", ros1),
        ("bag", connections),
    ]
}

/// Logs of CARMEN.
pub(super) fn carmen() -> Vec<Input> {
    let scan = |count: &str, reading: &str, place: &str, time: &str| {
        format!(
            "FLASER {count} {} {place} {place} 0 {place} {place} 0 {time} host {time}\n",
            vec![reading; 180].join(" ")
        )
    };
    let mut inputs = vec![
        text("clf", "FLASER 999999999999 1 2 3\n"),
        text("clf", "FLASER -1\nROBOTLASER1\nPARAM\nFLASER\n"),
        text("clf", "FLASER ".repeat(100_000)),
        text("clf", "ROBOTLASER1 0 0 1e308 1e-308 1e308 0 0 180 1 2 3\n"),
    ];
    for number in ["nan", "inf", "1e308", "-1e308", "-1", "0", "1e12", "1e-320"] {
        inputs.push(text("clf", scan("180", number, "0", "1").repeat(5)));
        inputs.push(text(
            "clf",
            scan("180", "2.0", "0", "1") + &scan("180", "2.0", number, "2").repeat(3),
        ));
        inputs.push(text(
            "clf",
            scan("180", "2.0", "0", "1") + &scan("180", "2.0", "0.1", number).repeat(3),
        ));
    }
    inputs
}

/// Launch files in XML that include themselves, or never end.
pub(super) fn launch_xml() -> Vec<Input> {
    vec![
        text("launch.xml", "<launch><include file=\"$(dirname)/x.launch.xml\"/></launch>"),
        text(
            "launch.xml",
            "<launch><include file=\"/dev/zero\"/><include file=\"/etc/passwd\"/></launch>",
        ),
        text("launch.xml", format!("<launch>{}</launch>", tower("<group>", "</group>", 20_000))),
        text(
            "launch.xml",
            format!("<launch>{}</launch>", "<node pkg=\"a\" exec=\"b\"/>".repeat(4_000)),
        ),
        text(
            "launch.xml",
            format!("<launch><arg name=\"a\" default=\"{}\"/></launch>", "$(var a)".repeat(1000)),
        ),
        text(
            "launch.xml",
            format!(
                "<launch><let name=\"a\" value=\"{}1{}\"/></launch>",
                "$(var ".repeat(20_000),
                ")".repeat(20_000)
            ),
        ),
        text("launch.xml", "<launch><let name=\"a\" value=\"$(eval '9**9**9')\"/></launch>"),
        text(
            "launch",
            "<launch><arg name=\"a\" value=\"$(eval 9**9**9)\"/><include file=\"$(dirname)/x.launch\"/></launch>",
        ),
        text("launch", "<launch><rosparam>&amp;a [*a, *a]</rosparam></launch>"),
    ]
}

/// Launch files in Python. They are trusted code; recursion and size must still not take the program down.
pub(super) fn launch_python() -> Vec<Input> {
    let of = |body: &str| {
        format!(
            "from launch import LaunchDescription\nfrom launch.actions import *\nfrom launch.substitutions import *\ndef f(context, *a, **k):\n    return [OpaqueFunction(function=f)]\ndef generate_launch_description():\n    {body}\n"
        )
    };
    vec![
        text("launch.py", of("return LaunchDescription([OpaqueFunction(function=f)])")),
        text("launch.py", of("return LaunchDescription([IncludeLaunchDescription(__file__)])")),
        text("launch.py", of("return generate_launch_description()")),
        text("launch.py", of("raise SystemExit(3)")),
        text("launch.py", of("import os; os._exit(7)")),
        text("launch.py", of("import os; os.abort()")),
        text("launch.py", of("return LaunchDescription([LogInfo(msg='x')] * 20000)")),
        text(
            "launch.py",
            of(
                "g = GroupAction([])\n    for i in range(5000): g = GroupAction([g])\n    return LaunchDescription([g])",
            ),
        ),
        text(
            "launch.py",
            of(
                "s = 'x'\n    for i in range(3000): s = PathJoinSubstitution([s, 'a'])\n    return LaunchDescription([LogInfo(msg=s)])",
            ),
        ),
        text("launch.py", of("return LaunchDescription([LogInfo(msg='x' * 50000000)])")),
        text("launch.py", of("print('x' * 30000000)\n    return LaunchDescription([])")),
        text("launch.py", of("import sys; sys.stdout.write('\\xff' * 1000); sys.stdout.close()")),
        text("launch.py", of("return 5")),
        text("launch.py", of("return LaunchDescription([5, None, 'a', [LogInfo(msg='x')]])")),
        text("launch.py", "x ="),
        text("launch.py", "\0\0\0"),
    ]
}
