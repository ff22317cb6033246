// render_mesh.c - The mesh that is drawn beside the hair, in OpenGL buffers.
#include "tools/common/render_mesh.h"
#include "tools/common/shaders.h"

#include <epoxy/gl.h>

#include <string.h>

static GLuint make_buffer(const void* bytes, size_t size)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, (GLsizeiptr)size, bytes, GL_DYNAMIC_STORAGE_BIT);
    return buffer;
}

static void attach(const struct hair_render_mesh* mesh, GLuint attribute)
{
    GLuint array = mesh->vertex_array;
    glVertexArrayVertexBuffer(array, attribute, mesh->buffer[attribute], 0, 3 * sizeof(float));
    glVertexArrayAttribFormat(array, attribute, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, attribute, attribute);
    glEnableVertexArrayAttrib(array, attribute);
}

void hair_render_mesh_delete(struct hair_render_mesh* mesh)
{
    glDeleteVertexArrays(1, &mesh->vertex_array);
    glDeleteBuffers(HAIR_MESH_BUFFERS, mesh->buffer);
    memset(mesh, 0, sizeof *mesh);
}

void hair_render_mesh_make(const struct head_mesh* mesh, bool whole, struct hair_render_mesh* out)
{
    hair_render_mesh_delete(out);
    size_t bytes = (size_t)mesh->vertex_count * 3 * sizeof(float);
    glCreateVertexArrays(1, &out->vertex_array);
    out->indices = 3 * (mesh->triangle_count - mesh->fine_count);
    out->fine_indices = 3 * mesh->fine_count;
    out->buffer[HAIR_MESH_POSITIONS] = make_buffer(mesh->positions, bytes);
    out->buffer[HAIR_MESH_NORMALS] = make_buffer(mesh->normals, bytes);
    out->buffer[HAIR_MESH_COLORS] = make_buffer(mesh->colors, bytes);
    out->buffer[HAIR_MESH_SURFACE] = make_buffer(mesh->surface, bytes);
    size_t triangle = 3 * sizeof(uint32_t);
    out->buffer[HAIR_MESH_TRIANGLES] = make_buffer(mesh->triangles, mesh->triangle_count * triangle);
    out->whole = whole;
    for (GLuint i = HAIR_MESH_POSITIONS; i <= HAIR_MESH_SURFACE; ++i) attach(out, i);
    glVertexArrayElementBuffer(out->vertex_array, out->buffer[HAIR_MESH_TRIANGLES]);
}

void hair_render_mesh_move(const struct hair_render_mesh* mesh, const struct head_mesh* to)
{
    GLsizeiptr bytes = (GLsizeiptr)to->vertex_count * 3 * (GLsizeiptr)sizeof(float);
    glNamedBufferSubData(mesh->buffer[HAIR_MESH_POSITIONS], 0, bytes, to->positions);
    glNamedBufferSubData(mesh->buffer[HAIR_MESH_NORMALS], 0, bytes, to->normals);
}

void hair_render_mesh_set_pose(unsigned program, const struct hair_head_pose* pose)
{
    glProgramUniformMatrix4fv(program, HAIR_AT_HEAD, 1, GL_FALSE, pose->transform);
    glProgramUniform4fv(program, HAIR_AT_HEIGHTS, 1, pose->heights);
    glProgramUniform4fv(program, HAIR_AT_BREATH, 1, pose->breath);
}

void hair_render_mesh_draw(const struct hair_render_mesh* mesh, unsigned program, const float transform[16],
                           float breath, const struct hair_matrices* matrices, bool has_fine)
{
    struct hair_head_pose pose = hair_head_pose_at(transform, breath, mesh->whole);
    uint32_t indices = mesh->indices + (has_fine ? mesh->fine_indices : 0);
    hair_render_mesh_set_pose(program, &pose);
    glProgramUniformMatrix4fv(program, HAIR_AT_VIEW, 1, GL_FALSE, matrices->view);
    glProgramUniformMatrix4fv(program, HAIR_AT_PROJECTION, 1, GL_FALSE, matrices->projection);
    glUseProgram(program);
    glBindVertexArray(mesh->vertex_array);
    glEnable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, (GLsizei)indices, GL_UNSIGNED_INT, NULL);
    glDisable(GL_CULL_FACE);
}
