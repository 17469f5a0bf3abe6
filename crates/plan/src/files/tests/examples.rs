//! Files as other programs write them, and their meaning.

use crate::{
    Document, FaultKind, HeightFrame, Home, ListKind, Loaded, NoteKind, ReadOptions, SourceFormat,
    command, read,
};

/// A file as Mission Planner writes it: home first, eight decimals.
pub(super) const WPL: &str = "QGC WPL 110\r\n\
    0\t1\t0\t16\t0\t0\t0\t0\t50.4501000\t30.5234000\t170.000000\t1\r\n\
    1\t0\t3\t22\t0.00000000\t0.00000000\t0.00000000\t0.00000000\t0.00000000\t0.00000000\t20.000000\t1\r\n\
    2\t0\t10\t16\t0.00000000\t0.00000000\t0.00000000\t0.00000000\t50.45110000\t30.52340000\t25.000000\t1\r\n\
    3\t0\t0\t177\t2.00000000\t5.00000000\t0.00000000\t0.00000000\t0.00000000\t0.00000000\t0.000000\t1\r\n\
    4\t0\t3\t20\t0.00000000\t0.00000000\t0.00000000\t0.00000000\t0.00000000\t0.00000000\t0.000000\t1\r\n";

/// A file as QGroundControl writes it: a takeoff, a survey with its items, a jump by id, a fence
/// and rally points.
pub(super) const PLAN: &str = r#"{
    "fileType": "Plan",
    "geoFence": {
        "breachReturn": [50.4502, 30.5235, 40],
        "circles": [
            { "circle": { "center": [50.451, 30.524], "radius": 35.5 }, "inclusion": false, "version": 1 }
        ],
        "polygons": [
            { "inclusion": true, "polygon": [[50.44, 30.51], [50.46, 30.51], [50.46, 30.54], [50.44, 30.54]], "version": 1 }
        ],
        "version": 2
    },
    "groundStation": "QGroundControl",
    "mission": {
        "cruiseSpeed": 15, "firmwareType": 3, "globalPlanAltitudeMode": 1, "hoverSpeed": 5,
        "items": [
            { "AMSLAltAboveTerrain": null, "Altitude": 20, "AltitudeMode": 1, "autoContinue": true, "command": 22,
              "doJumpId": 1, "frame": 3, "params": [0, 0, 0, null, 50.4501, 30.5234, 20], "type": "SimpleItem" },
            { "TransectStyleComplexItem": { "Items": [
                { "autoContinue": true, "command": 16, "doJumpId": 5, "frame": 3,
                  "params": [0, 0, 0, null, 50.4511, 30.5234, 20], "type": "SimpleItem" },
                { "autoContinue": true, "command": 16, "doJumpId": 6, "frame": 10,
                  "params": [0, 0, 0, null, 50.4521, 30.5234, 25], "type": "SimpleItem" } ] },
              "complexItemType": "survey", "type": "ComplexItem", "version": 5 },
            { "autoContinue": true, "command": 177, "doJumpId": 7, "frame": 2,
              "params": [5, 2, 0, 0, 0, 0, 0], "type": "SimpleItem" }
        ],
        "plannedHomePosition": [50.4501, 30.5234, 170], "vehicleType": 2, "version": 2
    },
    "rallyPoints": { "points": [[50.4503, 30.5236, 30]], "version": 2 },
    "version": 1
}"#;

pub(super) const OLD_FENCE: &str = "# a field\n50.450000\t30.520000\n50.440000\t30.510000\n\
    50.460000\t30.510000\n50.460000\t30.540000\n50.440000\t30.510000\n";

pub(super) const OLD_RALLY: &str =
    "RALLY 50.450000\t30.520000\t40.000000\t20.000000\t0.000000\t0\n";

pub(super) const KML: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2"><Document>
  <Folder><name>all &amp; sundry</name>
  <Placemark><name>way</name><LineString><altitudeMode>relativeToGround</altitudeMode>
    <coordinates>
      30.5234,50.4501,20
      30.5244,50.4511,25
    </coordinates></LineString></Placemark>
  <Placemark><MultiGeometry>
    <Point><coordinates>30.52,50.45</coordinates></Point>
    <Polygon><outerBoundaryIs><LinearRing><coordinates>30.51,50.44,0 30.54,50.44,0 30.54,50.46,0 30.51,50.44,0</coordinates></LinearRing></outerBoundaryIs>
      <innerBoundaryIs><LinearRing><coordinates>30.52,50.445 30.53,50.445 30.53,50.45</coordinates></LinearRing></innerBoundaryIs></Polygon>
  </MultiGeometry></Placemark>
  <Placemark><gx:Track><altitudeMode>absolute</altitudeMode><when>2020-01-01</when>
    <gx:coord>30.5244 50.4511 210</gx:coord><gx:coord>30.5254 50.4521 215</gx:coord></gx:Track></Placemark>
  </Folder></Document></kml>
"#;

pub(super) const GEOJSON: &str = r#"{ "type": "FeatureCollection", "features": [
  { "type": "Feature", "properties": { "name": "way" },
    "geometry": { "type": "MultiLineString", "coordinates": [[[30.5234, 50.4501, 190], [30.5244, 50.4511, 195]]] } },
  { "type": "Feature", "properties": null,
    "geometry": { "type": "GeometryCollection", "geometries": [
      { "type": "Polygon", "coordinates": [[[30.51, 50.44], [30.54, 50.44], [30.54, 50.46], [30.51, 50.44]]] },
      { "type": "MultiPoint", "coordinates": [[30.52, 50.45], [30.521, 50.451, 200]] } ] } } ] }"#;

/// A zip archive with two stored files, the second of them a KML document.
pub(super) fn zip(kml: &[u8]) -> Vec<u8> {
    archive(&[
        ("readme.txt", b"hello", 0, 5),
        ("doc.kml", kml, 0, kml.len()),
    ])
}

/// A zip archive of files, each given by its name, packed content, method and size.
fn archive(files: &[(&str, &[u8], u16, usize)]) -> Vec<u8> {
    let (mut bytes, mut directory) = (Vec::new(), Vec::new());
    for (name, packed, method, size) in files {
        let at = bytes.len() as u32;
        let mut common = Vec::new();
        common.extend([20, 0, 0, 0]);
        common.extend(method.to_le_bytes());
        common.extend([0; 8]);
        common.extend((packed.len() as u32).to_le_bytes());
        common.extend((*size as u32).to_le_bytes());
        common.extend((name.len() as u16).to_le_bytes());
        common.extend([0, 0]);
        bytes.extend(b"PK\x03\x04");
        bytes.extend(&common);
        bytes.extend(name.as_bytes());
        bytes.extend(*packed);
        directory.extend(b"PK\x01\x02\x14\x00");
        directory.extend(&common);
        directory.extend([0; 10]);
        directory.extend(at.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let start = bytes.len() as u32;
    bytes.extend(&directory);
    bytes.extend(b"PK\x05\x06\0\0\0\0");
    bytes.extend([files.len() as u8, 0, files.len() as u8, 0]);
    bytes.extend((directory.len() as u32).to_le_bytes());
    bytes.extend(start.to_le_bytes());
    bytes.extend([0, 0]);
    bytes
}

fn loaded(file: &[u8]) -> Loaded {
    read(file, &ReadOptions::default()).expect("a valid file")
}

fn commands(document: &Document, kind: ListKind) -> Vec<u16> {
    document
        .list(kind)
        .iter()
        .map(|item| item.command)
        .collect()
}

fn frames(document: &Document) -> Vec<u8> {
    document.plan.iter().map(|item| item.frame).collect()
}

const HOME: Home = Home {
    x: 504_501_000,
    y: 305_234_000,
    z: 170.0,
};

#[test]
fn waypoints_keep_their_frames_and_home_is_apart() {
    let found = loaded(WPL.as_bytes());
    assert_eq!(found.format, SourceFormat::Wpl);
    assert_eq!(found.document.home, Some(HOME));
    assert_eq!(commands(&found.document, ListKind::Plan), [22, 16, 177, 20]);
    assert_eq!(frames(&found.document), [3, 10, 0, 3]);
    assert_eq!(found.document.plan[1].height_frame(), HeightFrame::Terrain);
    assert_eq!(found.document.plan[1].x, 504_511_000);
    let span = found
        .places
        .item(ListKind::Plan, 1)
        .expect("it has a place");
    assert!(found.text[span].starts_with("2\t0\t10\t16"));
}

#[test]
fn a_file_without_home_counts_its_jumps_without_it() {
    let file = "QGC WPL 120\n0\t1\t3\t22\t0\t0\t0\tnan\t50\t30\t20\t1\n1\t0\t3\t177\t0\t2\t0\t0\t0\t0\t0\t1\n";
    let found = loaded(file.as_bytes()).document;
    assert_eq!(found.home, None);
    assert_eq!(found.plan[1].params[0].to_bits(), 1.0_f32.to_bits());
    assert!(found.plan[0].params[3].is_nan());
}

#[test]
fn a_home_without_a_height_counts_as_at_sea_level_and_is_noted() {
    let unknown = PLAN.replace("[50.4501, 30.5234, 170]", "[50.4501, 30.5234, null]");
    for file in [unknown, WPL.replace("170.000000", "nan")] {
        let read = loaded(file.as_bytes());
        assert_eq!(read.document.home, Some(Home { z: 0.0, ..HOME }));
        assert!(
            read.notes
                .iter()
                .any(|note| note.kind == NoteKind::HomeHeightMissing)
        );
    }
}

#[test]
fn a_plan_file_has_all_lists_with_the_items_of_its_survey() {
    let found = loaded(PLAN.as_bytes());
    assert_eq!(found.format, SourceFormat::QgcPlan);
    let document = &found.document;
    assert_eq!(document.home, Some(HOME));
    assert_eq!(commands(document, ListKind::Plan), [22, 16, 16, 177]);
    assert_eq!(frames(document), [3, 3, 10, 2]);
    // The id 5 is the second item.
    assert_eq!(document.plan[3].params[0].to_bits(), 2.0_f32.to_bits());
    assert_eq!(
        commands(document, ListKind::Fence),
        [5001, 5001, 5001, 5001, 5004, 5000]
    );
    assert_eq!(document.fence[4].params[0].to_bits(), 35.5_f32.to_bits());
    assert_eq!(commands(document, ListKind::Rally), [5100]);
}

#[test]
fn old_fences_and_rally_points_of_mavproxy_are_read() {
    let fence = loaded(OLD_FENCE.as_bytes());
    assert_eq!(fence.format, SourceFormat::OldFence);
    assert_eq!(
        commands(&fence.document, ListKind::Fence),
        [5000, 5001, 5001, 5001]
    );
    assert_eq!(
        fence.document.fence[1].params[0].to_bits(),
        3.0_f32.to_bits()
    );
    let rally = loaded(OLD_RALLY.as_bytes());
    assert_eq!(rally.format, SourceFormat::OldRally);
    assert_eq!(
        (rally.document.rally[0].frame, rally.document.rally[0].x),
        (3, 504_500_000)
    );
}

/// Three points are a triangle, and a ring that ends at its first point has no return point: all
/// points are corners.
#[test]
fn old_fences_without_a_return_point_are_read_in_any_order() {
    let triangle = ["50.45 30.52", "50.45 30.54", "50.46 30.54"];
    let [a, b, c] = triangle;
    for corners in [vec![a, b, c], vec![c, b, a], vec![a, b, c, a]] {
        let fence = loaded(corners.join("\n").as_bytes());
        assert_eq!(
            commands(&fence.document, ListKind::Fence),
            [5001; 3],
            "{corners:?}"
        );
    }
    let returning = [b, a, b, c, a].join("\n");
    let fence = loaded(returning.as_bytes());
    assert_eq!(
        commands(&fence.document, ListKind::Fence),
        [5000, 5001, 5001, 5001]
    );
    let between = [a, "50.45 30.53", b, c].join("\n");
    assert_eq!(loaded(between.as_bytes()).document.fence.len(), 4);
}

#[test]
fn all_shapes_of_a_kml_are_read_packed_or_not() {
    let plain = loaded(KML.as_bytes());
    assert_eq!(plain.format, SourceFormat::Kml);
    let packed = loaded(&zip(KML.as_bytes()));
    assert_eq!(packed.format, SourceFormat::Kmz);
    assert!(packed.document.is_same(&plain.document));
    let document = &plain.document;
    assert_eq!(frames(document), [10, 10, 0, 0]);
    assert_eq!(
        commands(document, ListKind::Fence),
        [5001, 5001, 5001, 5002, 5002, 5002]
    );
    assert_eq!(document.rally[0].frame, 3);
    let notes: Vec<&NoteKind> = plain.notes.iter().map(|note| &note.kind).collect();
    assert_eq!(
        notes,
        [&NoteKind::HeightAssumed(30.0), &NoteKind::LinesJoined(2)]
    );
}

#[test]
fn all_shapes_of_a_geojson_are_read() {
    let found = loaded(GEOJSON.as_bytes());
    assert_eq!(found.format, SourceFormat::GeoJson);
    assert_eq!(frames(&found.document), [0, 0]);
    assert_eq!(commands(&found.document, ListKind::Fence), [5001; 3]);
    assert_eq!(
        commands(&found.document, ListKind::Rally),
        [command::RALLY_POINT; 2]
    );
}

#[test]
fn deflated_archives_are_unpacked() {
    // `<kml><Placemark><Point><coordinates>1,2</coordinates></Point></Placemark></kml>`, three times, by zlib: with
    // fixed and with dynamic codes.
    let point = "<Placemark><Point><coordinates>1,2</coordinates></Point></Placemark>";
    let kml = format!("<kml>{}</kml>", point.repeat(3));
    for packed in [FIXED, DYNAMIC] {
        let bytes = archive(&[("a/Doc.KML", packed, 8, kml.len())]);
        assert_eq!(loaded(&bytes).text, kml);
    }
}

#[test]
fn faults_lie_where_they_are() {
    let fault = |file: &str| {
        let (text, faults) = read(file.as_bytes(), &ReadOptions::default()).expect_err("faulty");
        let fault = faults.into_iter().next().expect("a fault");
        (text[fault.span].to_owned(), fault.kind)
    };
    let (at, kind) = fault(&WPL.replace("\t50.45110000", "\tfifty"));
    assert_eq!(
        (at.as_str(), kind),
        ("fifty", FaultKind::NotANumber("fifty".to_owned()))
    );
    let (at, kind) = fault(&PLAN.replace("30.5234, 25]", "30.5234]"));
    assert_eq!(at, "[0, 0, 0, null, 50.4521, 30.5234]");
    assert!(matches!(kind, FaultKind::Expected(_)));
    let (at, _) = fault(&KML.replace("30.5244,50.4511,25", "30.5244;50.4511"));
    assert_eq!(at, "30.5244;50.4511");
    let (at, _) = fault(&GEOJSON.replace("[30.5244, 50.4511, 195]", "[30.5244, \"x\"]"));
    assert_eq!(at, "\"x\"");
    let (_, kind) = fault("hello\n");
    assert_eq!(kind, FaultKind::UnknownFormat);
}

const FIXED: &[u8] = &[
    179, 201, 206, 205, 177, 179, 9, 200, 73, 76, 78, 205, 77, 44, 202, 6, 50, 243, 51, 243, 74,
    236, 108, 146, 243, 243, 139, 82, 50, 243, 18, 75, 82, 139, 237, 12, 117, 140, 108, 244, 145,
    5, 108, 244, 161, 170, 244, 145, 53, 14, 18, 51, 244, 65, 62, 2, 0,
];
const DYNAMIC: &[u8] = &[
    5, 193, 209, 9, 192, 48, 8, 5, 192, 133, 10, 161, 253, 150, 55, 131, 43, 136, 241, 67, 146, 40,
    24, 247, 167, 119, 180, 206, 6, 241, 22, 181, 35, 181, 64, 156, 30, 13, 210, 204, 154, 30, 210,
    118, 241, 62, 31, 13, 205, 172, 233, 33, 109, 23, 52, 56, 61, 26, 52, 120, 139, 218, 145, 90,
    32, 222, 162, 118, 164, 22, 136, 211, 163, 65, 154, 89, 211, 67, 218, 46, 222, 231, 163, 161,
    153, 53, 61, 164, 237, 130, 6, 167, 71, 131, 6, 111, 81, 59, 82, 11, 196, 91, 212, 142, 212, 2,
    113, 122, 52, 72, 51, 107, 122, 72, 219, 197, 251, 124, 52, 52, 179, 166, 135, 180, 93, 208,
    224, 244, 104, 208, 224, 45, 106, 71, 106, 129, 198, 58, 27, 63,
];

/// A fence as older versions of QGroundControl wrote it: one polygon to stay in, and a return point
/// without a height.
#[test]
fn a_fence_of_version_1_is_read() {
    let plan = |fence: &str| {
        let text = format!(
            r#"{{ "fileType": "Plan", "geoFence": {fence}, "mission": {{ "items": [], "version": 2 }}, "version": 1 }}"#
        );
        read(text.as_bytes(), &ReadOptions::default())
    };
    let fenced = r#"{ "breachReturn": [50.45, 30.52], "version": 1,
        "polygon": [[50.44, 30.51], [50.46, 30.51], [50.46, 30.54]] }"#;
    let found = plan(fenced).expect("it is read").document.fence;
    let commands: Vec<u16> = found.iter().map(|item| item.command).collect();
    let corner = command::FENCE_POLYGON_INCLUSION;
    let expected = [corner, corner, corner, command::FENCE_RETURN_POINT];
    assert_eq!(commands, expected);
    assert_eq!((found[2].x, found[2].y), (504_600_000, 305_400_000));
    for empty in [r#"{ "polygon": [], "version": 1 }"#, r#"{ "version": 1 }"#] {
        assert!(plan(empty).expect("it is read").document.fence.is_empty());
    }
    assert!(plan(r#"{ "version": 3 }"#).is_err());
    assert!(plan(r#"{ "polygon": [[50.44, 30.51]], "version": 1 }"#).is_err());
}
