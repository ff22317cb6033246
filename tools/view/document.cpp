// document.cpp - The scene that the viewer edits, with undo.
#include "tools/view/document.h"

#include <string.h>

namespace
{

constexpr size_t max_steps = 100;

std::unique_ptr<hair_scene> copy(const hair_scene& scene)
{
    return std::make_unique<hair_scene>(scene);
}

bool move_step(view_document& document, std::deque<std::unique_ptr<hair_scene>>& from,
               std::deque<std::unique_ptr<hair_scene>>& to)
{
    view_document_commit(document);
    if (from.empty()) return false;
    to.push_back(std::move(document.committed));
    document.committed = std::move(from.back());
    from.pop_back();
    *document.scene = *document.committed;
    return true;
}

} // namespace

void view_document_open(view_document& document, const hair_scene& scene, const std::string& name,
                        const std::string& file)
{
    document.scene = copy(scene);
    document.committed = copy(scene);
    document.name = name;
    document.file = file;
    document.undo.clear();
    document.redo.clear();
    document.lists.push_back(scene.bullet);
}

void view_document_close(view_document& document)
{
    for (hair_bullet_list& list : document.lists) hair_scene_free_bullet(&list);
    document.lists.clear();
}

void view_document_commit(view_document& document)
{
    if (!memcmp(document.scene.get(), document.committed.get(), sizeof *document.scene)) return;
    document.undo.push_back(std::move(document.committed));
    if (document.undo.size() > max_steps) document.undo.pop_front();
    document.redo.clear();
    document.committed = copy(*document.scene);
}

bool view_document_undo(view_document& document)
{
    return move_step(document, document.undo, document.redo);
}

bool view_document_redo(view_document& document)
{
    return move_step(document, document.redo, document.undo);
}
