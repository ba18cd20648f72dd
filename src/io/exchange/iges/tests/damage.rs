use super::*;

const LINE: &str = "0.,0.,0.,1.,0.,0.";

/// Files with every entity that is read.
fn samples() -> Vec<String> {
    let shapes = [
        Given {
            matrix: 3,
            colour: -5,
            level: 1,
            ..given(
                126,
                "2,2,0,0,0,0,0.,0.,0.,1.,1.,1.,1.,2.,1.,0.,0.,0.,1.,1.,0.,2.,0.,0.,.25,.75,,,,,1,23",
            )
        },
        given(124, "1.,0.,0.,4.,0.,1.,0.,0.,0.,0.,1.,0."),
        given(314, "100.,50.,0.,6Horange"),
        given(104, "4.,0.,9.,0.,0.,-36.,2.,3.,0.,3.,0."),
        given(100, "5.,1.,2.,4.,2.,1.,5."),
        Given {
            form: 12,
            ..given(106, "2,3,0.,0.,1.,1.,0.,2.,4.,5.,6.")
        },
        given(112, "3,0,2,1,0.,1.,0.,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,0."),
        given(102, "2,9,7"),
        given(308, "0,4Hbolt,2,1,13"),
        given(408, "17,1.,2.,3.,4."),
        Given {
            form: 7,
            ..given(402, "2,1,9")
        },
        Given {
            form: 15,
            ..given(406, "1,4Hname")
        },
        Given {
            level: 1,
            form: 3,
            ..given(406, "2,0,4Hlvl1")
        },
        given(308, "0,1Hx,2,29,31"),
        given(408, "27,0.,0.,0.,1."),
        given(116, "1.,2.,3."),
        given(104, "9.,0.,-4.,0.,0.,-36.,1.,4.,-5.19,4.,5.19"),
    ];
    vec![
        file(&shapes),
        file(&[given(110, LINE), given(102, "1,1")]),
        file(&shapes).replace('\n', "\r\n"),
    ]
}

struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }
}

fn damaged(sample: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = sample.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        let end = (at + random.below(200)).min(bytes.len());
        match random.below(6) {
            0 => bytes[at] = random.below(256) as u8,
            1 => bytes.truncate(at.max(1)),
            2 => drop(bytes.drain(at..end)),
            3 => {
                let piece = bytes[at..end].to_vec();
                let target = random.below(bytes.len());
                bytes.splice(target..target, piece);
            }
            4 => {
                let digit = bytes
                    .iter()
                    .skip(at)
                    .position(u8::is_ascii_digit)
                    .map_or(at, |it| at + it);
                bytes[digit] = b"0123456789.,;H-"[random.below(15)];
            }
            _ => {
                let length = (bytes.len() - at).min(8);
                bytes[at..at + length].copy_from_slice(&b"99999999"[..length]);
            }
        }
        if bytes.is_empty() {
            break;
        }
    }
    bytes
}

#[test]
fn damaged_files_never_panic() {
    let samples = samples();
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    let mut survived = 0;
    for index in 0..3000 {
        let bytes = damaged(samples[index % samples.len()].as_bytes(), &mut random);
        if let Ok(drawing) = read(&bytes) {
            survived += usize::from(!drawing.items.is_empty());
            let _ = super::super::write(&drawing, "damaged");
        }
    }
    assert!(survived > 1500, "{survived}");
}

#[test]
fn samples_are_whole() {
    for sample in samples() {
        let drawing = read(sample.as_bytes()).unwrap();
        assert!(
            drawing
                .remarks
                .iter()
                .all(|it| it.contains("a part of itself") || it.contains("is never inserted")),
            "{:?}",
            drawing.remarks
        );
    }
}

#[test]
fn line_ends_of_every_kind_and_none_are_read() {
    let text = file(&[given(110, LINE)]);
    let read_all = |text: &str| read(text.as_bytes()).unwrap().items;
    let items = read_all(&text);
    assert_eq!(items.len(), 1);
    for other in [
        text.replace('\n', "\r\n"),
        text.replace('\n', "\r"),
        text.replace('\n', ""),
        format!("\u{feff}{text}"),
    ] {
        assert_eq!(read_all(&other), items);
    }
}

#[test]
fn flag_line_is_skipped_and_other_layouts_are_refused() {
    let text = file(&[given(110, LINE)]);
    let flagged = format!("{:<72}C{:>7}\n{text}", "", 1);
    assert_eq!(read(flagged.as_bytes()).unwrap().items.len(), 1);
    let compressed = format!("{:<72}C{:>7}\n{:<72}S{:>7}\nD1@1_110;\n", "", 1, "", 1);
    assert!(
        read(compressed.as_bytes())
            .unwrap_err()
            .reason
            .contains("compressed")
    );
    let binary = format!("{:<72}B{:>7}\n", "", 1);
    assert!(
        read(binary.as_bytes())
            .unwrap_err()
            .reason
            .contains("binary")
    );
    assert!(read(b"ISO-10303-21;\nHEADER;\n").is_err());
    assert!(read(b"").is_err());
}

#[test]
fn truncated_file_keeps_what_is_whole() {
    let text = file(&[
        given(110, LINE),
        given(110, &format!("{LINE},0,0")),
        given(110, LINE),
    ]);
    let cut = text.rfind("110,").unwrap();
    let drawing = read(&text.as_bytes()[..cut + 20]).unwrap();
    assert_eq!(drawing.items.len(), 2);
    assert!(has_remark(&drawing, "the terminate section is missing"));
    assert!(has_remark(
        &drawing,
        "type 110: its parameter line is missing"
    ));
}

#[test]
fn lines_without_a_section_are_named() {
    let text = file(&[given(110, LINE)]).replacen("         G", "        \u{7}G", 1);
    let spoiled = text.replacen("D      2", "x      2", 1);
    let drawing = read(spoiled.as_bytes()).unwrap();
    assert!(has_remark(
        &drawing,
        "line 5: no section letter in column 73"
    ));
    assert!(has_remark(
        &drawing,
        "line 4: directory line without its pair"
    ));
}

#[test]
fn parameters_of_another_entity_are_not_taken() {
    let text = file(&[given(110, LINE), given(116, "1.,2.,3.")]);
    let spoiled = text.replace("     116       2", "     116       1");
    let drawing = read(spoiled.as_bytes()).unwrap();
    assert_eq!(drawing.items.len(), 1);
    assert!(has_remark(
        &drawing,
        "type 116: its parameter lines belong to another entity"
    ));
}

/// Each subfigure inserts the next one twice: 2⁶⁰ lines.
#[test]
fn exponential_subfigures_are_cut_off() {
    let mut entities = vec![
        given(110, LINE),
        given(308, "0,1Ha,1,1"),
        given(408, "3,0.,0.,0.,1."),
    ];
    for level in 0..60 {
        let number = 2 * entities.len() + 1;
        entities.push(given(308, &format!("{level},1Ha,2,{0},{0}", number - 2)));
        entities.push(given(408, &format!("{number},1.,0.,0.,1.")));
    }
    let started = std::time::Instant::now();
    let drawing = read(file(&entities).as_bytes()).unwrap();
    assert!(drawing.items.len() > 100_000 && drawing.items.len() <= 1_000_000);
    assert!(
        has_remark(&drawing, "the rest is left out"),
        "{:?}",
        drawing.remarks
    );
    assert!(started.elapsed().as_secs() < 60);
}
