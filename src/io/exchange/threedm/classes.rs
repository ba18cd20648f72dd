//! The classes of objects, by the ids that the file gives them.

/// What an object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    NurbsCurve,
    PolyCurve,
    PolylineCurve,
    ArcCurve,
    CircleCurve,
    LineCurve,
    /// An arrow of version 2, a line in later ones.
    AnnotationArrow,
    Point,
    PointCloud,
    Brep,
    InstanceReference,
    /// What holds no curve that is read, by its name.
    Other(&'static str),
    /// A class that is not known.
    Unknown(u128),
}

pub(super) const NURBS_CURVE: u128 = 0x4ED7D4DD_E947_11D3_BFE5_0010830122F0;
pub(super) const POLY_CURVE: u128 = 0x4ED7D4E0_E947_11D3_BFE5_0010830122F0;
pub(super) const POLYLINE_CURVE: u128 = 0x4ED7D4E6_E947_11D3_BFE5_0010830122F0;
pub(super) const ARC_CURVE: u128 = 0xCF33BE2A_09B4_11D4_BFFB_0010830122F0;
pub(super) const LINE_CURVE: u128 = 0x4ED7D4DB_E947_11D3_BFE5_0010830122F0;
pub(super) const POINT: u128 = 0xC3101A1D_F157_11D3_BFE7_0010830122F0;
pub(super) const LAYER: u128 = 0x95809813_E985_11D3_BFE5_0010830122F0;

/// Every known class; several ids of one class are those of different years.
const CLASSES: [(u128, Class); 59] = [
    (NURBS_CURVE, Class::NurbsCurve),
    (0x5EAF1119_0B51_11D4_BFFE_0010830122F0, Class::NurbsCurve),
    (0x76A709D5_1550_11D4_8000_0010830122F0, Class::NurbsCurve),
    (POLY_CURVE, Class::PolyCurve),
    (0xEF638317_154B_11D4_8000_0010830122F0, Class::PolyCurve),
    (0x39FF3DD3_FE0F_4807_9D59_185F0D73C0E4, Class::PolyCurve),
    (POLYLINE_CURVE, Class::PolylineCurve),
    (ARC_CURVE, Class::ArcCurve),
    (0xCF33BE29_09B4_11D4_BFFB_0010830122F0, Class::CircleCurve),
    (LINE_CURVE, Class::LineCurve),
    (POINT, Class::Point),
    (0x2488F347_F8FA_11D3_BFEC_0010830122F0, Class::PointCloud),
    (0x60B5DBC5_E660_11D3_BFE4_0010830122F0, Class::Brep),
    (0x0705FDEF_3E2A_11D4_800E_0010830122F0, Class::Brep),
    (0x2D4CFEDB_3E2A_11D4_800E_0010830122F0, Class::Brep),
    (0xF06FC243_A32A_4608_9DD8_A7D2C4CE2A36, Class::Brep),
    (
        0xF9CFB638_B9D4_4340_87E3_C56E7865D96A,
        Class::InstanceReference,
    ),
    (
        0x4ED7D4D8_E947_11D3_BFE5_0010830122F0,
        Class::Other("CurveOnSurface"),
    ),
    (
        0x4ED7D4D9_E947_11D3_BFE5_0010830122F0,
        Class::Other("CurveProxy"),
    ),
    (
        0x42F47A87_5B1B_4E31_AB87_4639D78325D6,
        Class::Other("PolyEdgeSegment"),
    ),
    (
        0x4ED7D4E5_E947_11D3_BFE5_0010830122F0,
        Class::Other("PointGrid"),
    ),
    (0x4ED7D4E4_E947_11D3_BFE5_0010830122F0, Class::Other("Mesh")),
    (0xF09BA4D9_455B_42C3_BA3B_E6CCACEF853B, Class::Other("SubD")),
    (
        0x36F53175_72B8_4D47_BF1F_B4E6FC24F4B9,
        Class::Other("Extrusion"),
    ),
    (
        0x4ED7D4DE_E947_11D3_BFE5_0010830122F0,
        Class::Other("NurbsSurface"),
    ),
    (
        0x4760C817_0BE3_11D4_BFFE_0010830122F0,
        Class::Other("NurbsSurface"),
    ),
    (
        0xFA4FD4B5_1613_11D4_8000_0010830122F0,
        Class::Other("NurbsSurface"),
    ),
    (
        0x4ED7D4DF_E947_11D3_BFE5_0010830122F0,
        Class::Other("PlaneSurface"),
    ),
    (
        0xDBC5A584_CE3F_4170_98A8_497069CA5C36,
        Class::Other("ClippingPlaneSurface"),
    ),
    (
        0xA16220D3_163B_11D4_8000_0010830122F0,
        Class::Other("RevSurface"),
    ),
    (
        0x0A8401B6_4D34_4B99_8615_1B4E723DC4E5,
        Class::Other("RevSurface"),
    ),
    (
        0xC4CD5359_446D_4690_9FF5_29059732472B,
        Class::Other("SumSurface"),
    ),
    (
        0x665F6331_2A66_4CCE_81D0_B5EEBD9B5417,
        Class::Other("SumSurface"),
    ),
    (
        0x06936AFB_3D3C_41AC_BF70_C9319FA480A1,
        Class::Other("NurbsCage"),
    ),
    (
        0xD379E6D8_7C31_4407_A913_E3B7040D034A,
        Class::Other("MorphControl"),
    ),
    (
        0x0559733B_5332_49D1_A936_0532AC76ADE5,
        Class::Other("Hatch"),
    ),
    (
        0x85A08513_F383_11D3_BFE7_0010830122F0,
        Class::Other("Light"),
    ),
    (
        0xC8C66EFA_B3CB_4E00_9440_2AD66203379E,
        Class::Other("DetailView"),
    ),
    (
        0x74198302_CDF4_4F95_9609_6D684F22AB37,
        Class::Other("TextDot"),
    ),
    (
        0x8BD94E19_59E1_11D4_8018_0010830122F0,
        Class::Other("TextDot"),
    ),
    (
        0x8BD94E1A_59E1_11D4_8018_0010830122F0,
        Class::AnnotationArrow,
    ),
    (0x57376349_62A9_4A16_B411_A46BCD544790, Class::Other("Text")),
    (0x46F75541_F46B_48BE_AA7E_B353BBE068A7, Class::Other("Text")),
    (0x5DE6B210_486B_11D4_8014_0010830122F0, Class::Other("Text")),
    (
        0x945BF594_6FF9_4F5C_BFC0_B3AF528F29D2,
        Class::Other("Leader"),
    ),
    (
        0x14922B7A_5B65_4F11_8345_D415A9637129,
        Class::Other("Leader"),
    ),
    (
        0x5DE6B211_486B_11D4_8014_0010830122F0,
        Class::Other("Leader"),
    ),
    (
        0xE550882B_F44D_4154_A1EF_6E50CBBBF543,
        Class::Other("DimLinear"),
    ),
    (
        0xBD57F33B_A1B2_46E9_9C6E_AF09D30FFDDE,
        Class::Other("DimLinear"),
    ),
    (
        0x5DE6B20D_486B_11D4_8014_0010830122F0,
        Class::Other("DimLinear"),
    ),
    (
        0xFC749C2F_4C00_41FD_9840_26D94F047AD3,
        Class::Other("DimRadial"),
    ),
    (
        0xB2B683FC_7964_4E96_B1F9_9B356A76B08B,
        Class::Other("DimRadial"),
    ),
    (
        0x5DE6B20E_486B_11D4_8014_0010830122F0,
        Class::Other("DimRadial"),
    ),
    (
        0xD417786B_F6CD_4F12_9E1F_063F414DBEB6,
        Class::Other("DimAngular"),
    ),
    (
        0x841BC40B_A971_4A8E_94E5_BBA26D67348E,
        Class::Other("DimAngular"),
    ),
    (
        0x5DE6B20F_486B_11D4_8014_0010830122F0,
        Class::Other("DimAngular"),
    ),
    (
        0x03124828_4C9B_4D28_9A82_664DDDE7A14F,
        Class::Other("DimOrdinate"),
    ),
    (
        0xC8288D69_5BD8_4F50_9BAF_525A0086B0C3,
        Class::Other("DimOrdinate"),
    ),
    (
        0xD46767BA_7E8F_4D9D_9A92_66050219A5B9,
        Class::Other("Centermark"),
    ),
];

impl Class {
    /// The class of an id.
    pub(super) fn of(id: u128) -> Self {
        CLASSES
            .iter()
            .find(|(known, _)| *known == id)
            .map_or(Self::Unknown(id), |&(_, class)| class)
    }

    /// Whether it is a curve or a point that nests no other object.
    pub(super) fn is_plain(self) -> bool {
        matches!(
            self,
            Self::NurbsCurve
                | Self::PolylineCurve
                | Self::ArcCurve
                | Self::CircleCurve
                | Self::LineCurve
                | Self::AnnotationArrow
                | Self::Point
        )
    }

    /// The name in reports.
    pub(super) fn name(self) -> String {
        match self {
            Self::Other(name) => name.to_owned(),
            Self::Unknown(id) => format!("class {}", printed(id)),
            known => format!("{known:?}"),
        }
    }
}

/// An id as programs print it.
pub(super) fn printed(id: u128) -> String {
    let hex = format!("{id:032X}");
    [0..8, 8..12, 12..16, 16..20, 20..32]
        .map(|range| hex.get(range).unwrap_or_default())
        .join("-")
}
