//! The manual: the pages of `assets/help`, completed from the tables of operations and references.

use crate::geometry::references::KINDS;
use crate::operations::{self, Operation};

/// The pages in the order of the list: file and source.
const PAGES: [(&str, &str); 15] = [
    ("start.md", include_str!("../../assets/help/start.md")),
    ("curves.md", include_str!("../../assets/help/curves.md")),
    ("ends.md", include_str!("../../assets/help/ends.md")),
    ("plots.md", include_str!("../../assets/help/plots.md")),
    ("proofs.md", include_str!("../../assets/help/proofs.md")),
    ("harmony.md", include_str!("../../assets/help/harmony.md")),
    (
        "operations.md",
        include_str!("../../assets/help/operations.md"),
    ),
    (
        "references.md",
        include_str!("../../assets/help/references.md"),
    ),
    ("pictures.md", include_str!("../../assets/help/pictures.md")),
    ("files.md", include_str!("../../assets/help/files.md")),
    (
        "command-line.md",
        include_str!("../../assets/help/command-line.md"),
    ),
    ("freecad.md", include_str!("../../assets/help/freecad.md")),
    ("rhino.md", include_str!("../../assets/help/rhino.md")),
    ("inkscape.md", include_str!("../../assets/help/inkscape.md")),
    ("blender.md", include_str!("../../assets/help/blender.md")),
];

/// Hold a page of the manual.
pub struct Page {
    /// The name of its file, as links name it.
    pub file: &'static str,
    /// The sections; the first begins with the page's title.
    pub sections: Vec<Section>,
}

/// Hold a section: a heading and the text below it.
pub struct Section {
    /// The heading.
    pub title: &'static str,
    /// The heading as links name it.
    pub slug: String,
    /// The section in Markdown, with its heading.
    pub text: String,
}

impl Page {
    /// Return the page's title.
    pub fn title(&self) -> &'static str {
        self.sections.first().map_or("", |section| section.title)
    }
}

/// Make all pages.
pub fn pages() -> Vec<Page> {
    let page = |(file, source)| Page {
        file,
        sections: sections(source),
    };
    PAGES.map(page).into()
}

/// Write a heading as links name it: "Fit points" is "fit-points", as on the repository's pages.
pub fn slug(title: &str) -> String {
    let letters = title.to_lowercase();
    let letters = letters.chars().filter_map(|letter| match letter {
        ' ' => Some('-'),
        letter if letter.is_alphanumeric() || letter == '-' => Some(letter),
        _ => None,
    });
    letters.collect()
}

/// List the pages' links that a text holds.
pub fn links(text: &str) -> impl Iterator<Item = &str> {
    let targets = text.split("](").skip(1);
    targets.filter_map(|rest| rest.split(')').next())
}

/// Find the sections that hold all the words, whatever their case: pairs of page and section. Sections with a
/// word in their heading come first.
pub fn search(pages: &[Page], typed: &str) -> Vec<(usize, usize)> {
    let typed = typed.to_lowercase();
    let words: Vec<&str> = typed.split_whitespace().collect();
    let mut found = Vec::new();
    for (place, page) in pages.iter().enumerate() {
        for (number, section) in page.sections.iter().enumerate() {
            let text = section.text.to_lowercase();
            if words.iter().all(|word| text.contains(word)) {
                let title = section.title.to_lowercase();
                let is_named = words.iter().any(|word| title.contains(word));
                found.push((!is_named, (place, number)));
            }
        }
    }
    found.sort_by_key(|(later, _)| *later);
    found.into_iter().map(|(_, at)| at).collect()
}

fn sections(source: &'static str) -> Vec<Section> {
    let mut sections: Vec<Section> = Vec::new();
    for line in source.lines() {
        let heading = line.strip_prefix("# ").or(line.strip_prefix("## "));
        if let Some(title) = heading {
            sections.push(Section {
                title,
                slug: slug(title),
                text: String::new(),
            });
        }
        if let Some(section) = sections.last_mut() {
            section.text += line;
            section.text += "\n";
        }
    }
    for section in &mut sections {
        section.text += &added(section.title);
    }
    sections
}

/// Write what the tables add to a section: the parameters of an operation, the kinds of references.
fn added(title: &str) -> String {
    let mut operations = operations::ALL.iter();
    if let Some(operation) = operations.find(|operation| operation.label == title) {
        return parameters(operation);
    }
    if title != "Kinds" {
        return String::new();
    }
    let mut rows = "| kind | | parameters |\n|---|---|---|\n".to_owned();
    for kind in KINDS {
        let names: Vec<String> = kind.parameters.iter().map(|it| code(it.name)).collect();
        let cells = [code(kind.name), kind.help.to_owned(), names.join(", ")];
        rows += &row(&cells);
    }
    rows
}

fn parameters(operation: &Operation) -> String {
    let mut text = format!("\n{}. `batten apply {}`\n", operation.help, operation.name);
    if operation.parameters.is_empty() {
        return text;
    }
    text += "\n| parameter | | values | default |\n|---|---|---|---|\n";
    for parameter in operation.parameters {
        text += &row(&[
            format!(
                "{} {}",
                parameter.label,
                code(&format!("--{}", parameter.name))
            ),
            parameter.help.to_owned(),
            parameter.range_words(),
            parameter.default_words(),
        ]);
    }
    text
}

fn code(text: &str) -> String {
    format!("`{text}`")
}

fn row(cells: &[String]) -> String {
    let cells = cells.iter().map(|cell| cell.replace('|', "\\|"));
    format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_link_is_dead() {
        let pages = pages();
        let leads = |link: &str| {
            let (file, slug) = link.split_once('#').unwrap_or((link, ""));
            let page = pages.iter().find(|page| page.file == file);
            page.is_some_and(|page| {
                slug.is_empty() || page.sections.iter().any(|section| section.slug == slug)
            })
        };
        let readme = include_str!("../../README.md");
        let of_readme = links(readme).filter_map(|link| link.strip_prefix("assets/help/"));
        let sections = pages.iter().flat_map(|page| &page.sections);
        let all = sections.flat_map(|section| links(&section.text));
        let dead: Vec<&str> = all.chain(of_readme).filter(|link| !leads(link)).collect();
        assert_eq!(dead, Vec::<&str>::new());
        assert!(!leads("curves.md#no-such-section") && !leads("nowhere.md"));
    }

    #[test]
    fn every_operation_has_a_section_with_all_its_parameters() {
        let pages = pages();
        let page = pages.iter().find(|page| page.file == "operations.md");
        let page = page.expect("a page of operations");
        for operation in operations::ALL {
            let mut sections = page.sections.iter();
            let section = sections.find(|section| section.title == operation.label);
            let text = &section.expect(operation.label).text;
            for parameter in operation.parameters {
                assert!(text.contains(&format!("`--{}`", parameter.name)), "{text}");
            }
        }
        let is_known = |title| operations::ALL.iter().any(|it| it.label == title);
        let stale = page.sections.iter().skip(1).find(|it| !is_known(it.title));
        assert_eq!(
            stale.map(|section| section.title),
            None,
            "no such operation"
        );
    }

    #[test]
    fn every_kind_of_reference_is_listed() {
        let pages = pages();
        let mut sections = pages.iter().flat_map(|page| &page.sections);
        let kinds = sections.find(|section| section.title == "Kinds");
        let text = &kinds.expect("a section of kinds").text;
        for kind in KINDS {
            assert!(text.contains(&code(kind.name)), "{}", kind.name);
        }
    }

    #[test]
    fn a_search_takes_all_words_and_prefers_headings() {
        let pages = pages();
        let titles = |typed| -> Vec<&str> {
            let found = search(&pages, typed);
            found
                .iter()
                .map(|(page, at)| pages[*page].sections[*at].title)
                .collect()
        };
        assert_eq!(titles("safe REGION").first(), Some(&"Safe region"));
        assert!(titles("hard links").contains(&"Saving"));
        assert!(titles("polygon xylophone").is_empty());
    }
}
