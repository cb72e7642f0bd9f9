// occt_module.cpp: reads STEP, IGES and BREP files with OpenCASCADE (https://dev.opencascade.org), in the program
// lambent-import. Splits the exact surfaces into triangles, and marks the triangles' sides that are edges of the shape.
#include "flat_scene.h"

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <GeomLib.hxx>
#include <Geom_Surface.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IMeshTools_Parameters.hxx>
#include <NCollection_DataMap.hxx>
#include <Poly_Polygon3D.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <Quantity_ColorRGBA.hxx>
#include <STEPCAFControl_ExternFile.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_OutOfMemory.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GraphNode.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace
{

using namespace flat; // NOLINT: the module is this file

struct surface {
    std::vector<float> positions, normals;
    std::vector<uint32_t> indices;
    std::vector<uint8_t> inner; // lam_mesh.inner_edges
};

using group = std::pair<std::string, std::string>; // of faces: their material and name

void put(std::vector<float> &to, const gp_XYZ &v, double factor)
{
    for (int i = 1; i <= 3; i++)
        to.push_back(static_cast<float>(v.Coord(i) * factor));
}

class builder
{
  public:
    // `unit` is the number of millimetres in a unit of the file: OpenCASCADE converts all lengths to millimetres.
    builder(const Handle(TDocStd_Document) & from, flat::scene &to, const import_request &request, double unit)
        : out(to), colors(XCAFDoc_DocumentTool::ColorTool(from->Main())), most(request.triangles), scale(1 / unit),
          measured(request.measure != 0)
    {
        TDF_LabelSequence shapes;
        Bnd_Box box;
        XCAFDoc_DocumentTool::ShapeTool(from->Main())->GetFreeShapes(shapes);
        for (const TDF_Label &label : shapes) {
            const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
            if (!shape.IsNull())
                BRepBndLib::Add(shape, box);
            solid |= TopExp_Explorer(shape, TopAbs_FACE).More();
        }
        how.Deflection = box.IsVoid() ? 1 : request.deflection * std::sqrt(box.SquareExtent());
        // Neighbours along a curve meet at no more than 20°, more or less if the curves deviate more or less.
        how.Angle = std::min(std::max(0.35 * std::sqrt(4000 * request.deflection), 0.05), 1.0);
        how.MeshAlgo = IMeshTools_MeshAlgoType_Delabella; // two to three times as fast as the default
        list children;
        for (const TDF_Label &label : shapes)
            children.push_back(node(label, ""));
        out.root = add(out.nodes, object({{"children", children.empty() ? "" : array(children)}}));
    }

  private:
    flat::scene &out;
    const Handle(XCAFDoc_ColorTool) colors;
    const uint64_t most; // triangles
    const double scale;
    const bool measured;
    IMeshTools_Parameters how;
    bool solid = false; // there are surfaces; curves beside them are construction geometry
    uint64_t count = 0; // triangles so far, each mesh once
    std::map<std::string, std::string> materials;
    std::map<std::pair<const void *, std::string>, std::string> meshes; // of a shape with an inherited material
    TDF_LabelSequence path;                                             // from the root to the current node

    // --- names and colours

    static std::string name_of(const TDF_Label &label)
    {
        Handle(TDataStd_Name) name;
        if (!label.FindAttribute(TDataStd_Name::GetID(), name))
            return "";
        return text(TCollection_AsciiString(name->Get(), 0).ToCString()); // UTF-8
    }

    std::string material(const Quantity_ColorRGBA &color)
    {
        double c[4] = {0, 0, 0, static_cast<double>(color.Alpha())};
        color.GetRGB().Values(c[0], c[1], c[2], Quantity_TOC_sRGB);
        return material(numbers(c, 4));
    }

    std::string material(const std::string &color) // "": the neutral grey
    {
        std::string &index = materials[color];
        const std::string own = object({{"diffuse", color}, {"specular", "[0,0,0]"}});
        if (index.empty())
            index = add(out.materials,
                        object({{"doubleSided", "true"}, {"extensions", object({{"LAMBENT_material", own}})}}));
        return index;
    }

    // The material of a label's own colour, or else `other`.
    std::string material_of(const TDF_Label &label, const std::string &other)
    {
        Quantity_ColorRGBA color;
        return colors->GetColor(label, XCAFDoc_ColorSurf, color) || colors->GetColor(label, XCAFDoc_ColorGen, color)
                   ? material(color)
                   : other;
    }

    // --- nodes

    std::string matrix(const gp_Trsf &t) const
    {
        std::vector<double> m;
        for (int column = 1; column <= 4; column++)
            for (int row = 1; row <= 4; row++)
                m.push_back(row == 4 ? column == 4 : t.Value(row, column) * (column == 4 ? scale : 1));
        return t.Form() == gp_Identity ? "" : numbers(m.data(), m.size());
    }

    // Returns the label with the style that an assembly gives to the instance at the end of the path (SHUO). The
    // outermost assembly comes first. Without such a style, returns the instance's own label.
    TDF_Label styled() const
    {
        for (int first = 1; first < path.Length(); first++) {
            TDF_AttributeSequence any;
            TDF_LabelSequence labels;
            Handle(XCAFDoc_GraphNode) style;
            if (!XCAFDoc_ShapeTool::GetAllComponentSHUO(path(first), any))
                continue;
            for (int i = first; i <= path.Length(); i++)
                labels.Append(path(i));
            if (XCAFDoc_ShapeTool::FindSHUO(labels, style))
                return style->Label();
        }
        return path.Last();
    }

    // `inherited` is the material of parts without a colour. A part is named like its instance in the assembly; an
    // assembly has a node for the name of its instance and one for its own name.
    std::string node(const TDF_Label &label, const std::string &inherited)
    {
        TDF_Label part = label;
        XCAFDoc_ShapeTool::GetReferredShape(label, part);
        path.Append(label);
        const TDF_Label style = styled();
        const std::string color = material_of(style, material_of(label, material_of(part, inherited))),
                          own = name_of(label), product = name_of(part), name = own.empty() ? product : own;
        list children;
        TDF_LabelSequence components;
        const bool visible = colors->IsVisible(label) && colors->IsVisible(part) && colors->IsVisible(style);
        if (visible && XCAFDoc_ShapeTool::GetComponents(part, components))
            for (const TDF_Label &component : components)
                children.push_back(node(component, color));
        path.Remove(path.Length());
        if (!visible)
            return add(out.nodes, "{}");
        if (!children.empty() && name != product)
            children = {add(out.nodes, object({{"name", product}, {"children", array(children)}}))};
        return add(out.nodes, object({{"name", name},
                                      {"children", children.empty() ? "" : array(children)},
                                      {"mesh", children.empty() ? mesh(part, color) : ""},
                                      {"matrix", matrix(XCAFDoc_ShapeTool::GetLocation(label).Transformation())}}));
    }

    // --- meshes

    std::string mesh(const TDF_Label &label, const std::string &material)
    {
        const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
        if (shape.IsNull() || count > most) // the reader refuses this many triangles
            return "";
        std::string &known = meshes[{shape.TShape().get(), material}];
        if (!known.empty())
            return known;
        NCollection_DataMap<TopoDS_Shape, group, TopTools_ShapeMapHasher> faces; // with a material or name of their own
        TDF_LabelSequence parts;
        XCAFDoc_ShapeTool::GetSubShapes(label, parts);
        for (int type = TopAbs_COMPOUND; type <= TopAbs_FACE; type++) // a face's own colour replaces its body's
            for (const TDF_Label &part : parts) {
                const TopoDS_Shape of = XCAFDoc_ShapeTool::GetShape(part);
                const std::string color = material_of(part, ""), name = name_of(part);
                for (TopExp_Explorer e(of, TopAbs_FACE); of.ShapeType() == type && e.More(); e.Next()) {
                    const group *before = faces.Seek(e.Current());
                    group own = before ? *before : group(material, "");
                    faces.Bind(e.Current(), {color.empty() ? own.first : color, name.empty() ? own.second : name});
                }
            }
        BRepMesh_IncrementalMesh(shape, how);
        std::map<group, std::vector<TopoDS_Face>> groups;
        for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
            const group *own = faces.Seek(e.Current());
            groups[own ? *own : group(material, "")].push_back(TopoDS::Face(e.Current()));
        }
        list primitives = surface_of(groups, measured ? measure(shape) : std::pair<double, double>());
        for (TopExp_Explorer e(shape, TopAbs_EDGE); !solid && e.More(); e.Next())
            put_curve(TopoDS::Edge(e.Current()), primitives);
        if (!primitives.empty())
            known = add(out.meshes, object({{"name", name_of(label)}, {"primitives", array(primitives)}}));
        return known;
    }

    // The area of the exact shape and the volume that its faces enclose, to about six digits.
    std::pair<double, double> measure(const TopoDS_Shape &shape) const
    {
        const double precision = 1e-6;
        GProp_GProps area, volume;
        BRepGProp::SurfaceProperties(shape, area, precision);
        BRepGProp::VolumeProperties(shape, volume, precision);
        return {area.Mass() * scale * scale, std::abs(volume.Mass()) * scale * scale * scale};
    }

    // The pairs of consecutive nodes along a face's edges. The seam of a closed surface and the pole of a sphere are no
    // edges of the shape.
    static std::set<std::pair<int, int>> outline(const TopoDS_Face &face, const Handle(Poly_Triangulation) & triangles,
                                                 const TopLoc_Location &place)
    {
        std::set<std::pair<int, int>> sides;
        for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
            const TopoDS_Edge &edge = TopoDS::Edge(e.Current());
            const Handle(Poly_PolygonOnTriangulation) nodes = BRep_Tool::PolygonOnTriangulation(edge, triangles, place);
            if (nodes.IsNull() || BRep_Tool::Degenerated(edge) || BRep_Tool::IsClosed(edge, face))
                continue;
            for (int i = 1; i < nodes->NbNodes(); i++) {
                sides.emplace(nodes->Node(i), nodes->Node(i + 1));
                sides.emplace(nodes->Node(i + 1), nodes->Node(i));
            }
        }
        return sides;
    }

    void put_face(const TopoDS_Face &face, surface &to)
    {
        TopLoc_Location place;
        const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, place);
        if (triangles.IsNull())
            return;
        const Handle(Geom_Surface) exact = BRep_Tool::Surface(face);
        const gp_Trsf &move = place.Transformation();
        const std::set<std::pair<int, int>> sides = outline(face, triangles, place);
        const bool turned = face.Orientation() == TopAbs_REVERSED, mirrored = move.IsNegative();
        const auto first = static_cast<uint32_t>(to.positions.size() / 3);
        std::vector<gp_XYZ> points, sums(static_cast<size_t>(triangles->NbNodes()));
        for (int i = 1; i <= triangles->NbNodes(); i++) {
            points.push_back(triangles->Node(i).Transformed(move).XYZ());
            put(to.positions, points.back(), scale);
        }
        for (int i = 1; i <= triangles->NbTriangles(); i++) {
            int n[3];
            uint8_t inner = 8; // the outline is drawn as an edge (lam_mesh.inner_edges)
            triangles->Triangle(i).Get(n[0], n[1], n[2]);
            if (turned != mirrored)
                std::swap(n[1], n[2]);
            const gp_XYZ *p[3] = {&points.at(n[0] - 1), &points.at(n[1] - 1), &points.at(n[2] - 1)},
                         cross = (*p[1] - *p[0]) ^ (*p[2] - *p[0]);
            for (int k = 0; k < 3; k++) {
                to.indices.push_back(first + static_cast<uint32_t>(n[k] - 1));
                sums[static_cast<size_t>(n[k] - 1)] += cross;
                inner |= sides.count({n[k], n[(k + 1) % 3]}) ? 0 : 1 << k;
            }
            to.inner.push_back(inner);
        }
        count += static_cast<uint64_t>(triangles->NbTriangles());
        for (int i = 1; i <= triangles->NbNodes(); i++) {
            gp_Dir normal;
            gp_XYZ &own = sums[static_cast<size_t>(i - 1)];
            if (!exact.IsNull() && triangles->HasUVNodes() &&
                GeomLib::NormEstim(exact, triangles->UVNode(i), Precision::Confusion(), normal) <= 1)
                own = normal.Transformed(move).XYZ() * (turned != mirrored ? -1 : 1);
            const double length = own.Modulus();
            put(to.normals, length > 0 ? own : gp_XYZ(0, 0, 1), length > 0 ? 1 / length : 1);
        }
    }

    // Returns a primitive with the triangles of all faces, whose materials are in LAMBENT_faces.
    list surface_of(const std::map<group, std::vector<TopoDS_Face>> &groups, std::pair<double, double> size)
    {
        surface s;
        list parts;
        for (const auto &part : groups) {
            const size_t before = s.inner.size();
            const std::string &color = part.first.first;
            for (const TopoDS_Face &face : part.second)
                put_face(face, s);
            if (s.inner.size() > before)
                parts.push_back(object({{"material", color.empty() ? material("") : color},
                                        {"name", part.first.second},
                                        {"triangles", std::to_string(s.inner.size() - before)}}));
        }
        if (parts.empty())
            return {};
        const std::string attributes =
            object({{"POSITION", out.accessor(s.positions.data(), s.positions.size() / 3, F32, 3)},
                    {"NORMAL", out.accessor(s.normals.data(), s.normals.size() / 3, F32, 3)}});
        const std::string own = object({{"inner", out.accessor(s.inner.data(), s.inner.size(), U8, 1)},
                                        {"parts", array(parts)},
                                        {"area", size.first > 0 ? number(size.first) : ""},
                                        {"volume", size.second > 0 ? number(size.second) : ""}});
        return {object({{"attributes", attributes},
                        {"indices", out.accessor(s.indices.data(), s.indices.size(), U32, 1)},
                        {"extensions", object({{"LAMBENT_faces", own}})}})};
    }

    void put_curve(const TopoDS_Edge &edge, list &primitives)
    {
        TopLoc_Location place;
        const Handle(Poly_Polygon3D) line = BRep_Tool::Polygon3D(edge, place);
        if (line.IsNull() || line->NbNodes() < 2)
            return;
        std::vector<float> points;
        for (int i = 1; i <= line->NbNodes(); i++)
            put(points, line->Nodes().Value(i).Transformed(place.Transformation()).XYZ(), scale);
        const std::string positions = out.accessor(points.data(), points.size() / 3, F32, 3);
        primitives.push_back(object({{"attributes", object({{"POSITION", positions}})}, {"mode", "3"}}));
    }
};

// Gives the names of entities with faces to their shapes. OpenCASCADE's reader names only whole shapes.
void name_shapes(const Handle(IGESData_IGESModel) & model, const Handle(Transfer_TransientProcess) & results,
                 const Handle(XCAFDoc_ShapeTool) & shapes)
{
    for (int i = 1; i <= model->NbEntities(); i++) {
        const Handle(IGESData_IGESEntity) entity = model->Entity(i);
        const TopoDS_Shape shape = TransferBRep::ShapeResult(results, entity);
        TDF_Label label;
        if (!entity->HasName() || !TopExp_Explorer(shape, TopAbs_FACE).More() ||
            !shapes->SearchUsingMap(shape, label, false, true) || label.IsAttribute(TDataStd_Name::GetID()))
            continue;
        TCollection_AsciiString name = entity->NameValue()->String();
        name.LeftAdjust();
        name.RightAdjust();
        TDataStd_Name::Set(label, TCollection_ExtendedString(name));
    }
}

// Returns the millimetres in a unit of a STEP file, or 0.
double step_unit(STEPControl_Reader &reader)
{
    static const std::map<std::string, double> units = {
        {"metre", 1000},    {"millimetre", 1}, {"centimetre", 10}, {"decimetre", 100}, {"micrometre", 1e-3},
        {"kilometre", 1e6}, {"inch", 25.4},    {"foot", 304.8},    {"yard", 914.4},    {"mile", 1609344}};
    TColStd_SequenceOfAsciiString lengths, angles, solids;
    reader.FileUnits(lengths, angles, solids);
    if (lengths.IsEmpty())
        return 0;
    lengths.ChangeFirst().LowerCase();
    const auto found = units.find(lengths.First().ToCString());
    return found == units.end() ? 0 : found->second;
}

int read_shapes(const import_request &request, const uint8_t *bytes, flat::scene &out, char *note)
{
    Handle(TDocStd_Document) document = new TDocStd_Document("XCAF");
    const std::string format = request.format;
    double unit = 0;
    bool whole = false;
    XCAFDoc_DocumentTool::Set(document->Main(), false);
    XCAFDoc_ShapeTool::SetAutoNaming(false);
    std::istringstream stream(std::string(reinterpret_cast<const char *>(bytes), request.size));
    if (format == "step") {
        STEPCAFControl_Reader reader;
        reader.SetGDTMode(false);
        reader.SetLayerMode(false);
        reader.SetMatMode(false);
        reader.SetPropsMode(false);
        reader.SetSHUOMode(true);
        reader.SetViewMode(false);
        whole = reader.ChangeReader().ReadStream("", stream) == IFSelect_RetDone && reader.Transfer(document);
        unit = whole ? step_unit(reader.ChangeReader()) : 0;
        if (whole && !reader.ExternFiles().IsEmpty())
            std::snprintf(note, IMPORT_NOTE_SIZE, "its parts in %d other files are not read",
                          reader.ExternFiles().Extent());
    } else if (format == "iges") {
        IGESCAFControl_Reader reader;
        reader.SetLayerMode(false);
        reader.SetReadVisible(true);
        whole = reader.ReadFile(IMPORT_FILE) == IFSelect_RetDone && reader.Transfer(document);
        const Handle(IGESData_IGESModel) model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
        unit = model.IsNull() ? 0 : model->GlobalSection().UnitValue();
        if (whole)
            name_shapes(model, reader.WS()->TransferReader()->TransientProcess(),
                        XCAFDoc_DocumentTool::ShapeTool(document->Main()));
    } else {
        TopoDS_Shape shape;
        if (stream.str().compare(0, 7, "Open CA") == 0 || stream.str().compare(0, 8, "\nOpen CA") == 0)
            BinTools::Read(shape, stream);
        else
            BRepTools::Read(shape, stream, BRep_Builder());
        whole = !shape.IsNull();
        if (whole)
            XCAFDoc_DocumentTool::ShapeTool(document->Main())->AddShape(shape, true);
    }
    if (!whole) {
        std::snprintf(note, IMPORT_NOTE_SIZE, "OpenCASCADE finds no shape in it");
        return IMPORT_DAMAGED;
    }
    out.unit_m = unit / 1000;
    const builder made(document, out, request, unit > 0 ? unit : 1);
    return out.meshes.empty() && *note ? IMPORT_DAMAGED : IMPORT_READ;
}

int convert(const import_request &request, const uint8_t *bytes, flat::scene &out, char *note)
{
    try {
        return read_shapes(request, bytes, out, note);
    } catch (const Standard_OutOfMemory &) {
        return IMPORT_NO_MEMORY;
    } catch (const Standard_Failure &e) {
        const char *reason = e.GetMessageString(); // addresses may follow on more lines
        std::snprintf(note, IMPORT_NOTE_SIZE, "OpenCASCADE fails: %.*s", static_cast<int>(std::strcspn(reason, "\n")),
                      reason);
        return IMPORT_DAMAGED;
    }
}

int read(const import_request *request, const uint8_t *bytes, import_scene *scene, char *note)
{
    return flat::read(convert, request, bytes, scene, note);
}

const import_functions functions = {IMPORT_MODULE_VERSION, read};

} // namespace

extern "C" __attribute__((visibility("default"))) const import_functions *lambent_import_functions(void)
{
    return &functions;
}
