(* Reads certificates from a JSON file and gives them to the extracted checker: check FILE (- for stdin).

   Prints `accepted` (exit status 0), `refused` (1), or one line on stderr if the input is not a certificate (2). What is
   proved is `Checker.check` in Checker.v. This file, the compiler, Zarith and the lines of Extract.v are trusted. The
   grammar is in docs/certificates.md. *)

module Big = Z
open Checker

exception Unreadable of string

let unreadable format = Printf.ksprintf (fun message -> raise (Unreadable message)) format
let max_spheres = 1_000_000
let max_digits = 5_000

(* JSON, as in RFC 8259, but ASCII without backslashes, and numbers that are integers *)

type json =
  | Bool of bool
  | Number of string
  | Text of string
  | List of json list
  | Object of (string * json) list

let parse text =
  let at = ref 0 in
  let peek () = if !at < String.length text then text.[!at] else '\000' in
  let fail () = unreadable "byte %d is not JSON" !at in
  let next () = let c = peek () in if !at >= String.length text then fail () else (incr at; c) in
  let rec space () = match peek () with
    | ' ' | '\t' | '\n' | '\r' -> incr at; space ()
    | _ -> () in
  let expect c = if peek () = c && !at < String.length text then incr at else fail () in
  let word word value = String.iter expect word; value in
  let number () =
    let begun = !at in
    if peek () = '-' then incr at;
    while peek () >= '0' && peek () <= '9' do incr at done;
    if !at = begun then fail () else Number (String.sub text begun (!at - begun)) in
  let string () =
    expect '"';
    let begun = !at in
    while peek () <> '"' do if next () < ' ' then fail () done;
    incr at;
    String.sub text begun (!at - begun - 1) in
  let rec value depth =
    if depth > 100 then unreadable "the nesting is deeper than 100";
    space ();
    let found = match peek () with
      | '{' -> incr at; members depth
      | '[' -> incr at; elements depth
      | '"' -> Text (string ())
      | 't' -> word "true" (Bool true)
      | 'f' -> word "false" (Bool false)
      | _ -> number () in
    space ();
    found
  and elements depth =
    space ();
    if peek () = ']' then (incr at; List [])
    else
      let rec rest known = match (let one = value (depth + 1) in one :: known), next () with
        | known, ',' -> rest known
        | known, ']' -> List (List.rev known)
        | _ -> decr at; fail () in
      rest []
  and members depth =
    space ();
    if peek () = '}' then (incr at; Object [])
    else
      let rec rest known =
        space ();
        let key = string () in
        space ();
        expect ':';
        let one = value (depth + 1) in
        if List.mem_assoc key known then unreadable "a key occurs twice";
        match (key, one) :: known, next () with
        | known, ',' -> rest known
        | known, '}' -> Object (List.rev known)
        | _ -> decr at; fail () in
      rest [] in
  let found = value 0 in
  if !at < String.length text then fail ();
  found

(* Records *)

let record keys given = match given with
  | Object members when List.sort compare (List.map fst members) = List.sort compare keys ->
    List.map (fun key -> List.assoc key members) keys
  | _ -> unreadable "expected an object with the keys %s" (String.concat ", " keys)

let list given = match given with List entries -> entries | _ -> unreadable "expected a list"
let bool given = match given with Bool given -> given | _ -> unreadable "expected true or false"
let text given = match given with Text given -> given | _ -> unreadable "expected a string"

(* 0, or digits that do not begin with 0 *)
let is_natural text =
  text = "0" || (text <> "" && text.[0] <> '0' && String.for_all (fun c -> c >= '0' && c <= '9') text)

let unsigned text =
  if String.length text > 0 && text.[0] = '-' then String.sub text 1 (String.length text - 1) else text

let is_integer text = is_natural (unsigned text) && text <> "-0"

let number given : q =
  let given = text given in
  let numer, denom = match String.index_opt given '/' with
    | None -> given, "1"
    | Some at -> String.sub given 0 at, String.sub given (at + 1) (String.length given - at - 1) in
  let fits digits = String.length digits <= max_digits in
  if not (is_integer numer && is_natural denom && denom <> "0" && fits (unsigned numer) && fits denom) then
    unreadable "%S is not a number such as -7/3" given;
  qred { qnum = Big.of_string numer; qden = Big.of_string denom }

(* An integer in digits, from -2^127 to 2^127 - 1 *)
let whole digits =
  let bound = Big.shift_left Big.one 127 in
  let found = if is_integer digits && String.length digits <= 40 then Big.of_string digits else bound in
  if Big.lt found bound && Big.geq found (Big.neg bound) then found else unreadable "%S is not an integer of 128 bits" digits

let integer given = match given with
  | Number digits ->
    let found = whole digits in
    if Big.geq found (Big.neg (Big.shift_left Big.one 63)) && Big.lt found (Big.shift_left Big.one 64) then found
    else unreadable "%S is not an integer of 64 bits" digits
  | Text digits -> whole digits
  | _ -> unreadable "expected an integer"

let site given = match List.map integer (record [ "i"; "j"; "k" ] given) with
  | [ i; j; k ] -> k, (i, j)
  | _ -> assert false

(* A list of records as a tree; a key that occurs twice is an error. *)
let tree entry given =
  List.fold_left
    (fun known one ->
       let key, value = entry one in
       if M.mem key known then unreadable "a sphere occurs twice";
       M.add key value known)
    M.empty (list given)

let three given = match List.map number given with
  | [ alpha; beta; gamma ] -> { alpha; beta; gamma }
  | _ -> assert false

let of_sphere given = match record [ "site"; "alpha"; "beta"; "gamma" ] given with
  | place :: values -> site place, three values
  | [] -> assert false

(* The pile *)

let zero = { qnum = Big.zero; qden = Big.one }
let one = { qnum = Big.one; qden = Big.one }
let half = { qnum = Big.one; qden = Big.of_int 2 }
let is_negative x = Big.sign x.qnum < 0

let signs given =
  let refused () = unreadable "%S is not a stacking such as +-+ or (100,3,100)" given in
  let of_char = function '+' -> Plus | '-' -> Minus | _ -> refused () in
  if given = "A" then []
  else if given <> "" && String.for_all (fun c -> c = '+' || c = '-') given then List.map of_char (List.of_seq (String.to_seq given))
  else
    let runs = unsigned given in
    let n = String.length runs in
    if n < 3 || runs.[0] <> '(' || runs.[n - 1] <> ')' then refused ();
    let length run = if is_natural run && run <> "0" && String.length run <= 9 then int_of_string run else refused () in
    let runs = List.map length (String.split_on_char ',' (String.sub runs 1 (n - 2))) in
    if List.fold_left ( + ) 0 runs > max_spheres then unreadable "the pile is too large for this checker";
    let first, second = if given.[0] = '-' then Minus, Plus else Plus, Minus in
    List.concat (List.mapi (fun n run -> List.init run (fun _ -> if n mod 2 = 0 then first else second)) runs)

(* hexagon:N, hexagon:N,M, triangle:N, or region:A..B,C..D,E..F, with bounds of i, j and i+j *)
let region given =
  let refused () = unreadable "%S is not a region" given in
  let size digits = if is_natural digits then whole digits else refused () in
  let between text = match String.index_opt text '.' with
    | Some at when at + 1 < String.length text && text.[at + 1] = '.' ->
      whole (String.sub text 0 at), whole (String.sub text (at + 2) (String.length text - at - 2))
    | _ -> refused () in
  let sides n m = Big.sub Big.one m, Big.pred n in
  let bounds = match String.split_on_char ':' given with
    | [ "triangle"; n ] -> let both = sides (size n) Big.one in [ both; both; both ]
    | [ "hexagon"; n ] -> (match String.split_on_char ',' n with
        | [ n ] -> let both = sides (size n) (size n) in [ both; both; both ]
        | [ n; m ] -> let both = sides (size n) (size m) in [ both; both; both ]
        | _ -> refused ())
    | [ "region"; all ] -> List.map between (String.split_on_char ',' all)
    | _ -> refused () in
  match bounds with
  | [ (a, b); (c, d); (e, f) ] ->
    let area = Big.mul (Big.succ (Big.sub b a)) (Big.succ (Big.sub d c)) in
    if Big.gt area (Big.of_int (4 * max_spheres)) then unreadable "the pile is too large for this checker";
    { alpha = a; beta = c; gamma = e }, { alpha = b; beta = d; gamma = f }
  | _ -> refused ()

let with_default key value given = match given with
  | Object members when not (List.mem_assoc key members) -> Object ((key, value) :: members)
  | given -> given

let without_empty key given = match given with
  | Object members when List.assoc_opt key members = Some (List []) -> Object (List.remove_assoc key members)
  | given -> given

let no_tilt = Object [ "x", Text "0"; "y", Text "0" ]

let load given = match record [ "site"; "weight"; "x"; "y" ] (with_default "x" (Text "0") (with_default "y" (Text "0") given)) with
  | place :: values -> (match List.map number values with
      | [ down; x; y ] ->
        if is_negative down then unreadable "a load is negative";
        site place, { along_x = x; along_y = y; along_z = down }
      | _ -> assert false)
  | [] -> assert false

let weight given = match record [ "site"; "weight" ] given with
  | [ place; weight ] ->
    let weight = number weight in
    if is_negative weight then unreadable "a weight is negative";
    site place, weight
  | _ -> assert false

let sum v w = { along_x = qplus v.along_x w.along_x; along_y = qplus v.along_y w.along_y; along_z = qplus v.along_z w.along_z }

(* All spheres, layer by layer, until there are too many *)
let spheres pile =
  let grow = if pile.is_under_top then supports else supported in
  let rec from count known signs layer =
    let count = count + List.length layer in
    if layer = [] then unreadable "a layer has no spheres";
    if count > max_spheres then unreadable "the pile is too large for this checker";
    match signs with
    | [] -> layer @ known
    | sign :: signs -> from count (List.rev_append layer known) signs (grow pile.of_kind sign layer) in
  let signs = if pile.is_under_top then pile.signs else List.rev pile.signs in
  let first = Big.of_int (if pile.is_under_top then 0 else List.length signs) in
  from 0 [] signs (in_region pile.lower pile.upper first)

let pile given =
  let keys = [ "dimension"; "sin_phi"; "stacking"; "anchor"; "weightless"; "tilt"; "weights"; "loads" ] in
  match record keys (without_empty "horizontal" (with_default "tilt" no_tilt given)) with
  | [ dimension; sin_phi; stacking; anchor; weightless; tilt; own; extra ] ->
    let is_flat = match dimension with Number "2" -> true | Number "3" -> false | _ -> unreadable "dimension must be 2 or 3" in
    let weightless = bool weightless in
    let signs = signs (text stacking) in
    let sine = number sin_phi in
    let is_under_top, (lower, upper) = match anchor with
      | Object [ ("top", shape) ] -> true, region (text shape)
      | Object [ ("base", shape) ] -> false, region (text shape)
      | _ -> unreadable "the anchor must be a top or a base" in
    let tilt_x, tilt_y = match List.map number (record [ "x"; "y" ] tilt) with [ x; y ] -> x, y | _ -> assert false in
    let weights = tree weight own in
    let add known (place, load) =
      M.add place (match M.find place known with None -> load | Some other -> sum other load) known in
    let loads = List.fold_left add M.empty (List.map load (list extra)) in
    let weights = if weightless then M.map (fun _ -> zero) weights else weights in
    let ordinary_weight = if weightless then zero else one in
    let of_kind = if is_flat then Discs else if qeq_bool sine half then Equilateral else Isosceles sine in
    let pile = { of_kind; signs; is_under_top; lower; upper; ordinary_weight; tilt_x; tilt_y; weights; loads } in
    let sites = in_region lower upper Big.zero in
    let is_straight = is_under_top && sites = [ Big.zero, (Big.zero, Big.zero) ] && List.for_all (( = ) Plus) signs in
    (match of_kind with
     | Discs -> if not (is_straight && qeq_bool sine zero) then unreadable "discs need a straight pile under one disc"
     | Isosceles s -> if not (is_straight && Big.sign s.qnum > 0 && Big.lt s.qnum s.qden) then
         unreadable "sin_phi must be 1/2, or between 0 and 1 in a straight pile under one sphere"
     | Equilateral -> ());
    let there = set_of (spheres pile) in
    let are_there tree = List.for_all (fun (place, _) -> M.mem place there) (M.elements tree) in
    if not (are_there weights && are_there loads) then
      unreadable "the site of a weight or a load is not in the pile";
    if is_flat && not (qeq_bool tilt_y zero && List.for_all (fun (_, load) -> qeq_bool load.along_y zero) (M.elements loads)) then
      unreadable "a force on discs has a component along y";
    pile
  | _ -> assert false

(* The certificate *)

let axis given = match text given with
  | "alpha-beta" -> AB
  | "alpha-gamma" -> AG
  | "gamma-beta" -> GB
  | other -> unreadable "%S is not an axis" other

let push given = match record [ "site"; "axis"; "force" ] given with
  | [ place; along; force ] -> axis along, site place, number force
  | _ -> assert false

(* The horizontal forces of a sphere, in the order of the axes *)
let with_push known (axis, place, force) =
  let three = match M.find place known with Some three -> three | None -> { alpha = None; beta = None; gamma = None } in
  let fresh held = match held with None -> Some force | Some _ -> unreadable "a horizontal contact occurs twice" in
  M.add place
    (match axis with
     | AB -> { three with alpha = fresh three.alpha }
     | AG -> { three with beta = fresh three.beta }
     | GB -> { three with gamma = fresh three.gamma })
    known

let on_floor given = match record [ "site"; "normal"; "shear_x"; "shear_y" ] given with
  | place :: values -> (match List.map number values with
      | [ normal; x; y ] -> site place, { along_x = x; along_y = y; along_z = normal }
      | _ -> assert false)
  | [] -> assert false

let claim given = match given with
  | Text "stands" -> Stands
  | Text "cannot-stand" -> CannotStand
  | Object [ (("least" | "greatest") as kind, given) ] ->
    (match record [ "site"; "normal"; "attained" ] given with
     | [ place; normal; attained ] -> Bound ((if kind = "least" then Minus else Plus), site place, number normal, bool attained)
     | _ -> assert false)
  | Object [ ("elastic", given) ] ->
    (match record [ "stiffness_ratio" ] given with [ ratio ] -> Elastic (number ratio) | _ -> assert false)
  | Object [ ("forces", given) ] ->
    (match record [ "within"; "compressive"; "contacts"; "floor" ] given with
     | [ within; compressive; contacts; floor ] ->
       Forces (tree of_sphere contacts, tree on_floor floor, number within, bool compressive)
     | _ -> assert false)
  | _ -> unreadable "the claim is unknown"

let certificate given = match record [ "pile"; "claim"; "horizontal"; "field" ] given with
  | [ given; claimed; horizontal; field ] ->
    let about = pile given in
    let pushes = List.map push (list horizontal) in
    let held = function Some force -> force | None -> zero in
    let pushing = M.map (fun { alpha; beta; gamma } -> { alpha = held alpha; beta = held beta; gamma = held gamma })
        (List.fold_left with_push M.empty pushes) in
    { about; says = claim claimed; horizontal = List.map (fun (axis, place, _) -> axis, place) pushes; pushing;
      fields = tree of_sphere field }
  | _ -> assert false

let certificates given = match given with
  | List [] -> unreadable "the array of certificates is empty"
  | List all -> List.map certificate all
  | one -> [ certificate one ]

let read name =
  let channel = if name = "-" then stdin else open_in_bin name in
  set_binary_mode_in channel true;
  let buffer = Buffer.create 65_536 in
  (try while true do Buffer.add_channel buffer channel 1 done with End_of_file -> ());
  let text = Buffer.contents buffer in
  close_in channel;
  text

let () =
  let fail message = prerr_endline ("error: " ^ message); exit 2 in
  match Sys.argv with
  | [| _; name |] ->
    (match
       let text = read name in
       if String.exists (fun c -> c = '\\' || c > '\127') text then unreadable "a certificate is ASCII, without backslashes";
       List.for_all check (certificates (parse text))
     with
     | true -> print_endline "accepted"
     | false -> print_endline "refused"; exit 1
     | exception Unreadable message -> fail (name ^ ": " ^ message)
     | exception Sys_error message -> fail message
     | exception Stack_overflow -> fail (name ^ ": the pile is too large for this checker"))
  | _ -> fail "usage: check FILE, or - for stdin"
