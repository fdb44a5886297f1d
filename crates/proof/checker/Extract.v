From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlZBigInt ExtrOcamlNatInt QArith Qreduction.
From Cannonpile Require Import Directions Virtual Pile Checker.

(* Euclid's algorithm of Zarith, instead of that of the Coq library. *)
Extract Constant Qred =>
  "(fun { qnum = n; qden = d } ->
     let g = Big_int_Z.gcd_big_int n d in
     { qnum = Big_int_Z.div_big_int n g; qden = Big_int_Z.div_big_int d g })".

Extraction "checker.ml" check M.add M.mem M.map M.empty M.elements supports supported.
