//! The pages and their texts.

/// Name a page of the tour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaperPage {
    /// Figure 1: an arc of degree 9 with its float and closed S-polygons.
    Arc,
    /// The rounding test: one vertex of the closed S-polygon loses digits.
    Rounding,
    /// Table 1: circles as B-splines and as Bézier curves.
    Circles {
        /// The degree of the curves in the document.
        degree: usize,
    },
    /// The seven steps that move the ends of a curve to their targets.
    Steps,
    /// Figure 2: one polygon with growing legs, as float and as Bézier polygon.
    Typical,
    /// Figure 3: a conical spiral and two float polygons near it.
    Spiral {
        /// The number of vertices. The paper has 20, one per unit of the parameter.
        vertices: usize,
    },
    /// Section 6: two log-aesthetic parts joined by a bridge.
    Composite,
}

/// Hold a paragraph of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// A paragraph.
    Text(&'static str),
    /// A remark in smaller type.
    Note(&'static str),
    /// The place of the page's figures and controls.
    Figures,
}

impl PaperPage {
    /// Every page, in the order of the paper.
    pub const ALL: [Self; 7] = [
        Self::Arc,
        Self::Rounding,
        Self::Circles { degree: 9 },
        Self::Steps,
        Self::Typical,
        Self::Spiral { vertices: 20 },
        Self::Composite,
    ];

    /// Return the page's file: a heading, paragraphs, notes behind `>`, and a line `[figures]`.
    fn source(self) -> &'static str {
        match self {
            Self::Arc => include_str!("../../assets/paper/arc.md"),
            Self::Rounding => include_str!("../../assets/paper/rounding.md"),
            Self::Circles { .. } => include_str!("../../assets/paper/circles.md"),
            Self::Steps => include_str!("../../assets/paper/steps.md"),
            Self::Typical => include_str!("../../assets/paper/typical.md"),
            Self::Spiral { .. } => include_str!("../../assets/paper/spiral.md"),
            Self::Composite => include_str!("../../assets/paper/composite.md"),
        }
    }

    /// Return the page's title.
    pub fn title(self) -> &'static str {
        let first = self.source().lines().next();
        first.map_or("", |line| line.trim_start_matches("# "))
    }

    /// List the paragraphs below the title.
    pub fn blocks(self) -> impl Iterator<Item = Block> {
        let paragraphs = self.source().split("\n\n").skip(1).map(str::trim);
        paragraphs.map(|text| match text.strip_prefix("> ") {
            Some(note) => Block::Note(note),
            None if text == "[figures]" => Block::Figures,
            None => Block::Text(text),
        })
    }

    /// Return the page's place in [`PaperPage::ALL`].
    pub fn place(self) -> usize {
        let same = |page: &Self| std::mem::discriminant(page) == std::mem::discriminant(&self);
        Self::ALL.iter().position(same).unwrap_or_default()
    }
}
