//! JSON objects that keep what is unknown in them.
//!
//! Left alone, serde passes over unknown keys, and takes an array for a struct too, its elements
//! in the order in which the program declares the fields.

use std::fmt;

use serde::de::{DeserializeSeed, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer, forward_to_deserialize_any};
use serde_json::value::{RawValue, to_raw_value};

use crate::document::Extras;

/// A struct that is read from a JSON object, never from an array, with the keys that it does not
/// have. It is written with these after its own.
#[derive(Serialize)]
pub(super) struct Object<T> {
    /// The struct.
    #[serde(flatten)]
    pub value: T,
    /// What else is in the object.
    #[serde(flatten, serialize_with = "serialize_extras")]
    pub extras: Extras,
}

impl<T> Object<T> {
    /// Begin without further keys.
    pub(super) fn new(value: T) -> Self {
        let extras = Extras::default();
        Self { value, extras }
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut extras = Extras::default();
        let value = T::deserialize(ObjectDeserializer {
            inner: deserializer,
            extras: &mut extras,
        })?;
        Ok(Self { value, extras })
    }
}

/// Texts that are no JSON, which no reader makes, are written as strings.
fn serialize_extras<S: Serializer>(extras: &Extras, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(extras.iter().map(|(key, text)| {
        let raw = RawValue::from_string(text.to_owned());
        (key, raw.or_else(|_| to_raw_value(text)).ok())
    }))
}

struct ObjectDeserializer<'a, D> {
    inner: D,
    extras: &'a mut Extras,
}

impl<'de, D: Deserializer<'de>> Deserializer<'de> for ObjectDeserializer<'_, D> {
    type Error = D::Error;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, D::Error> {
        self.inner.deserialize_map(ObjectVisitor {
            visitor,
            fields,
            extras: self.extras,
        })
    }

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, D::Error> {
        self.inner.deserialize_any(visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option
        unit unit_struct newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

struct ObjectVisitor<'a, V> {
    visitor: V,
    fields: &'static [&'static str],
    extras: &'a mut Extras,
}

impl<'de, V: Visitor<'de>> Visitor<'de> for ObjectVisitor<'_, V> {
    type Value = V::Value;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.visitor.expecting(formatter)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<V::Value, A::Error> {
        self.visitor.visit_map(KnownKeys {
            map,
            fields: self.fields,
            extras: self.extras,
        })
    }
}

/// The entries that a struct has fields for; the others become extras on the way.
struct KnownKeys<'a, A> {
    map: A,
    fields: &'static [&'static str],
    extras: &'a mut Extras,
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for KnownKeys<'_, A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, A::Error> {
        while let Some(key) = self.map.next_key::<String>()? {
            if let Some(field) = self.fields.iter().find(|field| **field == key) {
                return seed.deserialize(field.into_deserializer()).map(Some);
            }
            let value: Box<RawValue> = self.map.next_value()?;
            self.extras.push(key, value.get());
        }
        Ok(None)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}
