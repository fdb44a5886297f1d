//! Serialisation of certificates. Maps are written as lists because their keys are not strings.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::data::listed;
use cannonpile::lattice::{HorizontalContact, Site};
use num_rational::BigRational;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::certificate::{Certificate, Claim};

#[derive(Serialize, Deserialize)]
#[serde(remote = "Certificate", rename = "Certificate", deny_unknown_fields)]
struct CertificateRecord {
    pile: Pile,
    claim: Claim,
    #[serde(with = "listed")]
    horizontal: BTreeMap<HorizontalContact, BigRational>,
    #[serde(with = "listed")]
    field: BTreeMap<Site, [BigRational; 3]>,
}

impl Serialize for Certificate {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        CertificateRecord::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for Certificate {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let certificate: Self = CertificateRecord::deserialize(deserializer)?;
        if certificate.pile.horizontal_forces().len() > 0 {
            return Err(D::Error::custom(
                "the pile of a certificate has horizontal forces; move them to the certificate",
            ));
        }
        Ok(certificate)
    }
}
