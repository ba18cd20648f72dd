//! Where each representation is placed: by relationships between representations and by mapped items.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DMat3;

use super::expansion::{Insertion, Placement, expand};
use super::instances::{Instance, Instances};
use super::placements::{axes, inverse, map};
use super::representations::{Representations, product_name, text};
use super::styles::{Style, Styles};
use super::text::decode;
use super::tokens::Value;
use crate::io::exchange::drawing::Affine;
use crate::io::exchange::remarks::Remarks;

/// Representations joined without a transformation share their placements: they are one node.
pub struct Assembly<'a> {
    /// The node of each representation.
    nodes: Vec<usize>,
    /// The placements of each node.
    placements: Vec<Vec<Placement<'a>>>,
}

impl<'a> Assembly<'a> {
    /// Work all placements out. `unit` is the length of the drawing's unit.
    pub fn read(
        file: &Instances<'a>,
        representations: &Representations<'a>,
        styles: &Styles<'a>,
        unit: Option<f64>,
        remarks: &mut Remarks,
    ) -> Self {
        let relations: Vec<Relation> = file
            .all()
            .filter_map(|it| Relation::read(&it, representations))
            .collect();
        let nodes = join(representations.list.len(), &relations);
        let mut builder = Builder {
            file,
            representations,
            nodes: &nodes,
            insertions: Vec::new(),
            remarks,
        };
        let usages = usages(file);
        for relation in relations.iter().filter(|it| it.transformation.is_some()) {
            builder.relation(relation, usages.get(&relation.id));
        }
        builder.mapped_items(styles);
        let insertions = builder.insertions;
        let units = |node: usize| {
            representations
                .list
                .get(node)
                .and_then(|it| it.units.length)
        };
        let roots = |node: usize| Placement {
            place: scale(ratio(units(node), unit)),
            ..Placement::default()
        };
        let placements = expand(&nodes, &insertions, roots, remarks);
        Self { nodes, placements }
    }

    /// Look at the placements of a representation, by its place in the list.
    pub fn of(&self, representation: usize) -> &[Placement<'a>] {
        let node = self.nodes.get(representation);
        node.and_then(|node| self.placements.get(*node))
            .map_or(&[], Vec::as_slice)
    }
}

/// A relationship between two representations of shape.
struct Relation {
    id: u64,
    line: u64,
    /// Places in the list of representations.
    ends: [usize; 2],
    /// Whether it has a transformation, and which.
    transformation: Option<u64>,
}

impl Relation {
    fn read(instance: &Instance, representations: &Representations) -> Option<Self> {
        const NAMES: [&str; 3] = [
            "REPRESENTATION_RELATIONSHIP",
            "SHAPE_REPRESENTATION_RELATIONSHIP",
            "CONSTRUCTIVE_GEOMETRY_REPRESENTATION_RELATIONSHIP",
        ];
        let mut parts = instance.parts();
        let [_, _, first, second] = parts
            .find(|(name, params)| NAMES.contains(name) && params.clone().next().is_some())
            .map(|(_, params)| params.first::<4>())?;
        let place = |value: &Value| representations.places.get(&value.reference()?).copied();
        let with = instance.part("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION");
        let with = with.map(|params| params.first::<1>()[0].reference().unwrap_or(0));
        Some(Self {
            id: instance.id,
            line: instance.line,
            ends: [place(&first)?, place(&second)?],
            transformation: with,
        })
    }
}

/// A product used in another: the NEXT_ASSEMBLY_USAGE_OCCURRENCE behind a relationship.
struct Usage {
    component: Option<u64>,
    name: Option<String>,
}

struct Builder<'a, 'r> {
    file: &'r Instances<'a>,
    representations: &'r Representations<'a>,
    nodes: &'r [usize],
    insertions: Vec<Insertion<'a>>,
    remarks: &'r mut Remarks,
}

impl<'a> Builder<'a, '_> {
    fn relation(&mut self, relation: &Relation, usage: Option<&Usage>) {
        let [first, second] = relation.ends;
        let component = usage.and_then(|it| it.component);
        let is_component = |place| component.is_some() && self.product(place) == component;
        // By the book the first is the component; some programs turn them round.
        let turned = is_component(second) && !is_component(first);
        let (child, parent) = if turned {
            (second, first)
        } else {
            (first, second)
        };
        let scale = self.ratio(child, parent);
        let id = relation.transformation.unwrap_or(0);
        let Some(place) = transformation(self.file, id, turned, scale) else {
            let entity = format!(
                "#{} REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION",
                relation.id
            );
            self.remarks.add_at(
                relation.line,
                &entity,
                "its transformation is damaged; the part is not placed",
            );
            return;
        };
        let name = component.and_then(|id| product_name(self.file, id));
        let name = name.or_else(|| usage.and_then(|it| it.name.clone()));
        let block = name.or_else(|| self.name(child));
        self.insert(child, parent, relation.line, place, block, Style::default());
    }

    fn mapped_items(&mut self, styles: &Styles<'a>) {
        for (parent, representation) in self.representations.list.iter().enumerate() {
            for id in representation.items.clone().refs() {
                let Some(item) = self.file.get_if(id, "MAPPED_ITEM") else {
                    continue;
                };
                match self.mapped(&item, parent) {
                    Some((child, place)) => {
                        let block = self.name(child);
                        let style = styles.of(id, Style::default());
                        self.insert(child, parent, item.line, place, block, style);
                    }
                    None => {
                        let entity = format!("#{id} MAPPED_ITEM");
                        self.remarks.add_at(
                            item.line,
                            &entity,
                            "its map or target is damaged, skipped",
                        );
                    }
                }
            }
        }
    }

    fn mapped(&self, item: &Instance<'a>, parent: usize) -> Option<(usize, Affine)> {
        let [_, source, target] = item.named_params::<3>("MAPPED_ITEM");
        let source = self.file.get(source.reference()?)?;
        let [origin, representation] = source.part("REPRESENTATION_MAP")?.first::<2>();
        let child = *self
            .representations
            .places
            .get(&representation.reference()?)?;
        let origin = axes(self.file, origin.reference()?)?;
        let target = map(self.file, target.reference()?)?;
        Some((child, joined(&target, &origin, self.ratio(child, parent))))
    }

    fn insert(
        &mut self,
        child: usize,
        parent: usize,
        line: u64,
        place: Affine,
        block: Option<String>,
        style: Style<'a>,
    ) {
        let node = |place: usize| self.nodes.get(place).copied();
        if let (Some(child), Some(parent)) = (node(child), node(parent)) {
            let place = (place != Affine::default()).then_some(place);
            let placement = Placement {
                place,
                block: block.map(Arc::from),
                style,
            };
            self.insertions.push(Insertion {
                child,
                parent,
                line,
                placement,
            });
        }
    }

    fn ratio(&self, child: usize, parent: usize) -> f64 {
        let units = |place: usize| {
            self.representations
                .list
                .get(place)
                .and_then(|it| it.units.length)
        };
        ratio(units(child), units(parent))
    }

    fn product(&self, place: usize) -> Option<u64> {
        self.representations.list.get(place)?.product
    }

    fn name(&self, place: usize) -> Option<String> {
        let product = self
            .product(place)
            .and_then(|id| product_name(self.file, id));
        product.or_else(|| {
            let name = decode(self.representations.list.get(place)?.name?);
            (!name.trim().is_empty()).then_some(name)
        })
    }
}

/// Read a transformation from the component to the assembly.
fn transformation(file: &Instances, id: u64, turned: bool, scale: f64) -> Option<Affine> {
    let instance = file.get(id)?;
    if let Some(params) = instance.part("ITEM_DEFINED_TRANSFORMATION") {
        let [_, _, first, second] = params.first::<4>();
        let first = axes(file, first.reference()?)?;
        let second = axes(file, second.reference()?)?;
        return Some(if turned {
            joined(&first, &second, scale)
        } else {
            joined(&second, &first, scale)
        });
    }
    let place = map(file, id)?;
    Some(joined(&place, &Affine::default(), scale))
}

/// The map that takes the frame `from` to the frame `to`.
fn joined(to: &Affine, from: &Affine, scale: f64) -> Affine {
    if to == from && scale == 1.0 {
        return Affine::default();
    }
    let back = inverse(from);
    to.of(&Affine {
        linear: back.linear * scale,
        origin: back.origin * scale,
    })
}

fn ratio(inner: Option<f64>, outer: Option<f64>) -> f64 {
    match (inner, outer) {
        (Some(inner), Some(outer)) => inner / outer,
        _ => 1.0,
    }
}

fn scale(ratio: f64) -> Option<Affine> {
    (ratio != 1.0).then(|| Affine {
        linear: DMat3::IDENTITY * ratio,
        ..Affine::default()
    })
}

/// The usages by the relationships that place them.
fn usages(file: &Instances) -> HashMap<u64, Usage> {
    let mut usages = HashMap::new();
    for link in file
        .all()
        .filter(|it| it.is("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION"))
    {
        let [relation, shape] = link.params().first::<2>();
        let read = || {
            let [_, _, usage] = file.get(shape.reference()?)?.params().first::<3>();
            let [id, name, _, _, component] = file.get(usage.reference()?)?.params().first::<5>();
            Some(Usage {
                component: component.reference(),
                name: text(&name).or_else(|| text(&id)),
            })
        };
        if let (Some(relation), Some(usage)) = (relation.reference(), read()) {
            usages.entry(relation).or_insert(usage);
        }
    }
    usages
}

/// Join the representations that are related without a transformation.
fn join(count: usize, relations: &[Relation]) -> Vec<usize> {
    let mut nodes: Vec<usize> = (0..count).collect();
    let root = |nodes: &mut Vec<usize>, mut place: usize| {
        while let Some(next) = nodes.get(place).copied().filter(|next| *next != place) {
            let beyond = nodes.get(next).copied().unwrap_or(next);
            if let Some(node) = nodes.get_mut(place) {
                *node = beyond;
            }
            place = next;
        }
        place
    };
    for relation in relations.iter().filter(|it| it.transformation.is_none()) {
        let [first, second] = relation.ends.map(|place| root(&mut nodes, place));
        let (low, high) = (first.min(second), first.max(second));
        if let Some(node) = nodes.get_mut(high) {
            *node = low;
        }
    }
    (0..count).map(|place| root(&mut nodes, place)).collect()
}
