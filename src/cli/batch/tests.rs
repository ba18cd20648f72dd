//! Files that fail in ways that no operation of the program should.

use super::super::ends::{Destination, Source};
use super::*;
use crate::document::{Curve, Document};
use crate::geometry::FloatPolygon;
use crate::operations::{Deviation, Inputs, Operation, Outcome};

/// Panics where the curve begins right of the origin.
static PANIC: Operation = Operation {
    name: "panic",
    label: "Panic",
    help: "Panic now and then",
    inputs: Inputs::One,
    each: false,
    parameters: &[],
    check: |_| Ok(()),
    unused: |_| &[],
    run: |input, _, _| {
        let begin = input.polygon()?.vertices()[0].x;
        assert!(begin <= 0.0, "begins at {begin}");
        Ok(Outcome {
            reached: true,
            deviation: Deviation::Unmeasured,
            ..Outcome::default()
        })
    },
};

#[test]
fn a_panic_is_the_error_of_its_file_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |(name, x): (&str, f64)| {
        let path = folder.path().join(name).with_extension("csv");
        let polygon = FloatPolygon::planar(1, &[(x, 0.0), (9.0, 0.0)]).expect("a polygon");
        let document = Document::from_curves([Curve::new(name, polygon)]);
        disk::write_document(&path, &document, None).expect("written");
        path
    };
    let files = [("a", 0.0), ("b", 7.0), ("c", 0.0)].map(file).into();
    let folder = folder.path().to_owned();
    let many = ManyFiles {
        files: ManyFiles::named(files, &folder, None).expect("different stems"),
        folder,
        jobs: None,
        full: false,
    };
    let application = |[file, out]: &[PathBuf; 2]| Application {
        operation: &PANIC,
        source: Source::new(file.clone(), None, None),
        second: None,
        destination: Destination::File(out.clone(), None),
        curves: [None, None],
        values: Vec::new(),
        assumed_unit: None,
        best: false,
        text: false,
    };
    let applications: Vec<Application> = many.files.iter().map(application).collect();
    let (sender, receiver) = mpsc::sync_channel(applications.len());
    work(&many, &applications, &AtomicUsize::new(0), &sender);
    drop(sender);
    let told: Vec<Told> = receiver.iter().collect();
    let failed: Vec<bool> = told.iter().map(|told| told.failed).collect();
    assert_eq!(failed, [false, true, false]);
    let bad = &told[1].text;
    assert!(
        bad.contains("b.csv: the operation failed: begins at 7"),
        "{bad}"
    );
    assert!(
        bad.contains("\"out\":null,\"reached\":null,\"extrema\":null"),
        "{bad}"
    );
    assert!(
        told[2].text.contains("\"reached\":true,\"extrema\":0"),
        "{}",
        told[2].text
    );
    let is_written = many.files.iter().map(|[_, out]| out.exists());
    assert_eq!(is_written.collect::<Vec<_>>(), [true, false, true]);
}
